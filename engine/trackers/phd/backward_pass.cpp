// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/backward_pass.hpp"

#include <algorithm>
#include <cmath>

#include "glint/engine/filters/bernoulli.hpp"

namespace glint {
namespace {

// The backward pass must not draw the same random numbers as the targets.
constexpr std::uint64_t kBackward = std::uint64_t{0xB5} << 56;
// Existence that a point before the detection needs: a start claimed too early costs more than one
// frame too late.
constexpr double kSure = 0.9;

}  // namespace

BackwardPass::BackwardPass(const FollowedTargetsConfig& config, const MotionConfig& motion,
                           int frames, const Device& device, std::uint64_t seed)
    : config_(config),
      survival_(motion.survival),
      modes_(motion.bank().modes.size()),
      filters_(reversed(motion.bank()), config.target_particles, device, seed ^ kBackward),
      // The detection lies confirm_hits - 1 frames before the confirmation.
      capacity_(frames > 0 ? static_cast<std::size_t>(frames + config.confirm_hits - 1) : 0) {}

void BackwardPass::remember(const Frame& z, const StepTime& at, std::span<const Position> tracks) {
  if (capacity_ == 0) return;
  if (past_.size() < capacity_) past_.emplace_back();
  Past& past = past_[next_];
  past.z = z, past.at = at, past.tracks.assign(tracks.begin(), tracks.end());
  next_ = (next_ + 1) % capacity_;
}

void BackwardPass::restored() const {
  const bool full = past_.size() == capacity_;
  require_bytes(past_.size() <= capacity_ &&
                    (full ? next_ < std::max<std::size_t>(capacity_, 1) : next_ == past_.size()),
                "the stored frames are not that many");
  for (const Past& past : past_) require_bytes(bool{past.z}, "a stored frame is missing");
}

bool BackwardPass::near_another(const Past& past, const Peak& estimate, std::uint32_t id) const {
  return std::ranges::any_of(past.tracks, [&](const Position& other) {
    return other.id != id &&
           std::hypot(other.x - estimate.x, other.y - estimate.y) < config_.separation;
  });
}

std::vector<BackwardPass::Earlier> BackwardPass::earlier_points(const Start& start) {
  std::vector<Earlier> points;
  std::int64_t frame = start.now;
  double existence = 1, log_weight = 0;
  int misses = 0;
  for (std::size_t back = 1; back <= past_.size(); ++back) {
    const Past& past = past_[(next_ + past_.size() - back) % past_.size()];
    const auto step = static_cast<double>(frame - past.at.frame);
    filters_.predict(past.at.frame, step);
    frame = past.at.frame;
    const TargetUpdate& update = filters_.update(past.z, frame)[0];
    if (update.mean_ratio <= 0) break;
    if (frame < start.detected) {
      const double survival = std::pow(survival_, step);
      existence = bernoulli_update(existence, survival, update.mean_ratio);
      misses = existence >= config_.existence ? 0 : misses + 1;
      if (misses >= config_.halt_misses || near_another(past, update.estimate, start.id)) break;
      log_weight += std::log(survival * update.mean_ratio);
      TrackPoint point = point_of(update.estimate, modes_, past.at);
      point.vx = -point.vx, point.vy = -point.vy;
      point.track_id = start.id, point.status = TrackStatus::confirmed;
      points.push_back({point, log_weight});
    }
    filters_.resample(frame);
  }
  return points;
}

void BackwardPass::trace(const TargetFilters& targets, std::size_t t, const Start& start,
                         TrackLog& log) {
  filters_.clear();
  filters_.add(targets, t);
  trace(start, log);
}

void BackwardPass::trace(const Cluster& cluster, const Start& start, TrackLog& log) {
  filters_.clear();
  filters_.add(cluster.particles, cluster.members, start.now);
  trace(start, log);
}

void BackwardPass::trace(const Start& start, TrackLog& log) {
  filters_.reverse_velocities();
  const std::vector<Earlier> points = earlier_points(start);
  double most = 0;  // of the logarithms; that of the frame of detection is 0
  for (const Earlier& earlier : points) most = std::max(most, earlier.log_weight);
  double all = std::exp(-most), later = all;  // in units of the greatest
  for (const Earlier& earlier : points) all += std::exp(earlier.log_weight - most);
  for (const Earlier& earlier : points) {
    TrackPoint point = earlier.point;
    point.existence = 1 - later / all;
    if (point.existence < kSure) return;
    log.revise(point);
    later += std::exp(earlier.log_weight - most);
  }
}

}  // namespace glint
