// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/viterbi/viterbi.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "glint/engine/tracks/tracker_state.hpp"
#include "glint/kernels/dp_stage/dp_stage.hpp"
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"

namespace glint {

Viterbi::Viterbi(const ViterbiConfig& config, const Device& device, std::uint64_t /*seed*/)
    : config_(valid(config)),
      device_(device),
      appearance_(config),
      window_(config.window, config.separation, device) {
  if (config.common_frames > config.window) {
    throw ConfigError("common_frames must not exceed window: lower common_frames or raise window");
  }
}

void Viterbi::restored() const {
  require_bytes(window_.stages() == static_cast<std::size_t>(config_.window) &&
                    times_.size() == window_.filled(),
                "the window is not whole");
  for (const Track& track : tracks_) {
    require_bytes(!track.points.empty(), "a track has no points");
    for (const TrackPoint& point : track.points) require_frame_number(point.frame);
  }
}

void Viterbi::step(const Scan& scan, TrackLog& log) {
  if (scan.whitened.width() == 0) return;
  appearance_.look_at(scan);
  const StepTime at = clock_.tick(scan);
  score(scan.whitened, at.step, scan.cues);
  if (times_.size() == static_cast<std::size_t>(config_.window)) times_.erase(times_.begin());
  times_.push_back(at);
  if (!window_.full()) return;
  for (Track& track : tracks_) track.seen = false;
  for (const WindowPath& path : window_.find(static_cast<float>(config_.threshold))) {
    // A shorter one could continue no track, and would be a new one wherever one has ended.
    if (path.last - path.first >= static_cast<std::size_t>(config_.common_frames)) {
      stitch(path, log);
    }
  }
  forget(log);
}

namespace {

/// Adds the logarithm of the probability of each pixel given the cue, over that of any pixel of the
/// frame, where it is above 0.
void add_prior(const Cue& cue, const Device& device, ImageView<float> map) {
  constexpr double kSigma = 2;  // unless the cue says it [px]
  const double variance = std::pow(std::max(cue.sigma_or(kSigma), 0.5), 2);  // cells are pixels
  const double pixels = static_cast<double>(map.width) * map.height;
  const double most = std::log(pixels / (2 * std::numbers::pi * variance));
  if (!(most > 0)) return;
  const double reach = std::sqrt(2 * variance * most);
  const auto first = [](double from) { return std::max(0, static_cast<int>(std::ceil(from))); };
  const auto last = [](double to, int size) {
    return std::min(size - 1, static_cast<int>(std::floor(to)));
  };
  for (int y = first(cue.y - reach); y <= last(cue.y + reach, map.height); ++y) {
    const std::span row(map.row(y), static_cast<std::size_t>(map.width));
    device.fetch(row);
    for (int x = first(cue.x - reach); x <= last(cue.x + reach, map.width); ++x) {
      const double square = (x - cue.x) * (x - cue.x) + (y - cue.y) * (y - cue.y);
      const double prior = most - square / (2 * variance);
      if (prior > 0) row[static_cast<std::size_t>(x)] += static_cast<float>(prior);
    }
    device.send(row);
  }
}

}  // namespace

void Viterbi::score(const Frame& z, double step, std::span<const Cue> cues) {
  PixelLikelihood::Args args;
  args.frame = z.for_kernels();
  args.spread = appearance_.spread();
  args.intensity = (appearance_.intensity_low() + appearance_.intensity_high()) / 2;
  args.threshold = std::numeric_limits<float>::infinity();
  args.map = window_.next(z.width(), z.height());
  device_.run<PixelLikelihood>(args);
  for (const Cue& cue : cues) add_prior(cue, device_, args.map);
  const auto pixels = [step](double per_frame) {
    return static_cast<int>(std::min<double>(std::ceil(per_frame * step), kMaxDpReach));
  };
  window_.push({pixels(config_.speed_max), pixels(config_.acceleration_max)});
}

/// Mean over the frames that both have; infinite for too few.
double Viterbi::distance(const Track& track, const WindowPath& path) const {
  double sum = 0;
  int common = 0;
  for (const TrackPoint& p : track.points) {
    for (std::size_t k = path.first; k < path.last; ++k) {
      if (times_[k].frame != p.frame) continue;
      sum += std::hypot(p.x - path.cells[k].x, p.y - path.cells[k].y), ++common;
    }
  }
  const int least = track.halted ? 1 : config_.common_frames;
  return common < least ? std::numeric_limits<double>::infinity() : sum / common;
}

/// The nearest track that no better path continues, or a new one.
Viterbi::Track& Viterbi::owner(const WindowPath& path) {
  Track* nearest = nullptr;
  double least = config_.separation;
  for (Track& track : tracks_) {
    const double d = track.seen ? least : distance(track, path);
    if (d < least) least = d, nearest = &track;
  }
  if (nearest == nullptr) nearest = &tracks_.emplace_back(Track{next_id_++, {}});
  nearest->seen = true;
  return *nearest;
}

namespace {

/// Of the cell at stage k, with the velocity from stage a to stage b: errors of cells at different
/// stages have nothing to do with each other.
StateCovariance covariance_of(const WindowPath& path, std::size_t a, std::size_t k, std::size_t b,
                              double seconds) {
  const WindowPath::Cell& cell = path.cells[k];
  StateCovariance c;
  c.var_x = cell.var_x, c.cov_xy = cell.cov_xy, c.var_y = cell.var_y;
  if (!(seconds > 0)) return c;
  const WindowPath::Cell &from = path.cells[a], &to = path.cells[b];
  const double share = ((k == b ? 1 : 0) - (k == a ? 1 : 0)) / seconds;  // of the velocity's error
  c.cov_x_vx = share * cell.var_x, c.cov_y_vy = share * cell.var_y;
  c.cov_x_vy = c.cov_y_vx = share * cell.cov_xy;
  const double square = seconds * seconds;
  c.var_vx = (from.var_x + to.var_x) / square, c.var_vy = (from.var_y + to.var_y) / square;
  c.cov_vx_vy = (from.cov_xy + to.cov_xy) / square;
  return c;
}

}  // namespace

TrackPoint Viterbi::point_of(const WindowPath& path, std::size_t k, std::int64_t id) const {
  TrackPoint point;
  point.frame = times_[k].frame, point.time = times_[k].time;
  point.track_id = id;
  point.status = TrackStatus::confirmed;
  point.x = path.cells[k].x, point.y = path.cells[k].y;
  // Cells are whole pixels: the velocity is that over up to five of them.
  const std::size_t a = k < path.first + 2 ? path.first : k - 2;
  const std::size_t b = std::min(k + 2, path.last - 1);
  const double seconds = times_[b].time - times_[a].time;
  if (seconds > 0) {
    point.vx = (path.cells[b].x - path.cells[a].x) / seconds;
    point.vy = (path.cells[b].y - path.cells[a].y) / seconds;
  }
  point.existence = 1 / (1 + std::exp(-path.log_odds));
  point.set_covariance(covariance_of(path, a, k, b, seconds));
  return point;
}

void Viterbi::stitch(const WindowPath& path, TrackLog& log) {
  Track& track = owner(path);
  if (track.halted) return;
  std::vector<TrackPoint>& points = track.points;
  const std::size_t newest = times_.size() - 1;
  const std::int64_t end = times_[path.last - 1].frame;
  const std::size_t held = points.size();
  while (!points.empty() && points.back().frame > end) points.pop_back();
  if (points.size() < held) log.drop(track.id, end + 1);
  const auto settled = static_cast<std::size_t>(config_.settled_frames);
  for (std::size_t k = path.first; k < path.last; ++k) {
    const auto at = std::ranges::lower_bound(points, times_[k].frame, {}, &TrackPoint::frame);
    const bool known = at != points.end() && at->frame == times_[k].frame;
    if (known && newest - k >= settled) continue;
    const TrackPoint point = point_of(path, k, track.id);
    if (known) {
      *at = point;
    } else {
      points.insert(at, point);
    }
    if (k == newest) {
      log.report(point);
    } else {
      log.revise(point);
    }
  }
}

void Viterbi::halt(Track& track, TrackLog& log) const {
  const TrackPoint& last = track.points.back();
  TrackPoint point = last;
  point.frame = times_.back().frame, point.time = times_.back().time;
  point.status = TrackStatus::halted;
  point.existence = 0;  // no path shows it any more
  log.report(point);
  log.drop(track.id, last.frame + 1);
  track.halted = true;
}

/// Tracks halt `halt_frames` after their last point, or when the window holds too few for a path
/// to be matched to, and leave with the window.
void Viterbi::forget(TrackLog& log) {
  const int frames = std::min(
      {config_.halt_frames, config_.window - 1, config_.window - config_.common_frames + 1});
  const std::size_t over = times_.size() - 1 - static_cast<std::size_t>(frames);
  for (Track& track : tracks_) {
    if (!track.halted && track.points.back().frame <= times_[over].frame) halt(track, log);
  }
  std::erase_if(tracks_, [&](Track& track) {
    std::erase_if(track.points,
                  [&](const TrackPoint& p) { return p.frame < times_.front().frame; });
    return track.points.empty();
  });
}

template class TrackerOf<Viterbi>;

}  // namespace glint
