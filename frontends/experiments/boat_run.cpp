// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/experiments/boat_run.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

constexpr double kBoatCutoff = 20;  // [m]
constexpr double kBorder = 60;      // [m] of clutter about the truths

double distance(const Position& a, const Position& b) { return std::hypot(a.x - b.x, a.y - b.y); }

std::span<const TruthPoint> boats_at(std::span<const TruthPoint> truth, std::int64_t frame) {
  // Not std::ranges::equal_range(): clang 14 cannot compile that of g++'s library.
  const auto earlier = [](const TruthPoint& point, std::int64_t f) { return point.frame < f; };
  const auto first = std::lower_bound(truth.begin(), truth.end(), frame, earlier);
  return {first, std::lower_bound(first, truth.end(), frame + 1, earlier)};
}

/// Scans as a tracker of points takes them.
class PointScans {
 public:
  explicit PointScans(const BoatRecord& record) : record_(record) {}
  Scan at(std::size_t i) {
    points_.clear();
    for (const Position& p : record_.scans[i].points) {
      points_.push_back({p.x, p.y, 10});
    }
    Scan scan;
    scan.frame = static_cast<std::int64_t>(i), scan.time = record_.scans[i].time;
    scan.sensor_x = record_.scans[i].ship.x, scan.sensor_y = record_.scans[i].ship.y;
    scan.points = points_;
    return scan;
  }

 private:
  const BoatRecord& record_;
  std::vector<PointMeasurement> points_;
};

/// Which track was started for which boat.
using Own = std::map<std::int64_t, std::int64_t>;

/// Starts those that came within reach at this scan; the tracker numbers its tracks from 1.
void start_new(std::span<const TruthPoint> now, std::span<const TruthPoint> before,
               std::int64_t& next, ImmJpda& tracker, Own& own) {
  for (const TruthPoint& boat : now) {
    if (std::ranges::find(before, boat.track_id, &TruthPoint::track_id) != before.end()) continue;
    tracker.start(boat.x, boat.y, boat.vx, boat.vy);
    own[boat.track_id] = next++;
  }
}

void judge_last(std::span<const TruthPoint> truth, std::span<const TrackPoint> reported,
                const Own& own, BoatScore& score) {
  for (const TruthPoint& boat : truth) {
    const auto started = own.find(boat.track_id);
    if (started == own.end()) continue;
    const auto track = std::ranges::find(reported, started->second, &TrackPoint::track_id);
    const TruthPoint* nearest = nullptr;
    double least = kBoatCutoff;
    if (track != reported.end() && track->status != TrackStatus::halted) {
      for (const TruthPoint& other : truth) {
        const double d = distance({track->x, track->y}, {other.x, other.y});
        if (d <= least) least = d, nearest = &other;
      }
    }
    if (nearest == nullptr) ++score.lost;
    if (nearest != nullptr && nearest->track_id != boat.track_id) ++score.swapped;
  }
}

/// Numbers in (0, 1), counted out: a function of the key.
class Draws {
 public:
  explicit Draws(const RandomKey& key) : key_(key) {}
  double next() { return (random_words(key_, item_++).w[0] + 0.5) * 0x1p-32; }
  /// The number of unit exponentials that fit into `mean`.
  int poisson(double mean) {
    int count = -1;
    for (double sum = 0; sum <= mean; ++count) sum -= std::log(next());
    return count;
  }

 private:
  RandomKey key_;
  std::uint32_t item_ = 0;
};

Coverage coverage_of(std::int64_t boat, std::vector<TruthPoint> truth,
                     const std::vector<TrackPoint>& tracks, const EvaluationOptions& options) {
  std::erase_if(truth, [&](const TruthPoint& t) { return t.track_id != boat; });
  std::map<std::int64_t, std::vector<TrackPoint>> apart;
  for (const TrackPoint& p : tracks) apart[p.track_id].push_back(p);
  Coverage coverage{evaluate(truth, tracks, options).detected_points, 0};
  for (const auto& [id, points] : apart) {
    coverage.one = std::max(coverage.one, evaluate(truth, points, options).detected_points);
  }
  return coverage;
}

std::map<std::int64_t, double> first_confirmed(const std::vector<TrackPoint>& online,
                                               const Evaluation& scores) {
  std::map<std::int64_t, double> first;
  for (const TrackPoint& p : online) {  // by scan
    const auto boat = scores.counts_for.find(p.track_id);
    if (p.status != TrackStatus::confirmed || boat == scores.counts_for.end()) continue;
    if (boat->second) first.try_emplace(*boat->second, static_cast<double>(p.frame + 1));
  }
  return first;
}

/// By scan.
std::vector<bool> echoes_of(std::int64_t boat, const BoatRecord& record, double reach) {
  std::vector<bool> echo(record.scans.size());
  for (const TruthPoint& t : record.truth) {
    if (t.track_id != boat) continue;
    const auto scan = static_cast<std::size_t>(t.frame);
    echo[scan] = std::ranges::any_of(record.scans[scan].points, [&](const Position& p) {
      return distance(p, {t.x, t.y}) <= reach;
    });
  }
  return echo;
}

Box box_about(std::span<const TruthPoint> truth) {
  const auto [left, right] = std::ranges::minmax(truth, {}, &TruthPoint::x);
  const auto [low, high] = std::ranges::minmax(truth, {}, &TruthPoint::y);
  return {static_cast<int>(std::floor(left.x - kBorder)),
          static_cast<int>(std::floor(low.y - kBorder)),
          static_cast<int>(std::ceil(right.x + kBorder)),
          static_cast<int>(std::ceil(high.y + kBorder))};
}

}  // namespace

BoatRecord changed(const BoatRecord& record, const BoatTrial& trial) {
  BoatRecord result;
  const Box box = box_about(record.truth);
  const double width = box.x1 - box.x0, height = box.y1 - box.y0;
  for (std::size_t i = 0; i < record.scans.size(); ++i) {
    const BoatScan& scan = record.scans[i];
    const auto in_reach = [&](const Position& p) { return distance(p, scan.ship) <= trial.reach; };
    Draws draws(random_key(trial.seed, i, Purpose::trial));
    BoatScan kept{scan.time, scan.ship, {}};
    for (const Position& p : scan.points) {
      if (draws.next() < trial.keep && in_reach(p)) kept.points.push_back(p);
    }
    for (int c = draws.poisson(trial.clutter * width * height); c > 0; --c) {
      const double x = box.x0 + width * draws.next();
      kept.points.push_back({x, box.y0 + height * draws.next()});
    }
    result.scans.push_back(std::move(kept));
    for (const TruthPoint& t : boats_at(record.truth, static_cast<std::int64_t>(i))) {
      if (in_reach({t.x, t.y})) result.truth.push_back(t);
    }
  }
  return result;
}

double confirmable_at(const BoatRecord& record, std::int64_t boat, const HitLogic& logic,
                      double reach) {
  const std::vector<bool> echo = echoes_of(boat, record, reach);
  double earliest = kUndefined;
  for (std::size_t first = echo.size(); first-- > 0;) {
    const std::size_t end =
        std::min(first + static_cast<std::size_t>(logic.confirm_window), echo.size());
    if (first + 1 >= end || !echo[first] || !echo[first + 1]) continue;
    int hits = 0;
    for (std::size_t scan = first; scan < end; ++scan) {
      if (!echo[scan] || ++hits < logic.confirm_hits) continue;
      earliest = std::fmin(earliest, static_cast<double>(scan + 1));
      break;
    }
  }
  return earliest;
}

BoatScore follow_boats(const BoatRecord& record, const ImmJpdaConfig& config, double reach) {
  ImmJpda tracker(config, Device::serial(), 1);
  TrackLog log;
  PointScans scans(record);
  Own own;
  std::int64_t next = 1;
  std::span<const TruthPoint> before;
  for (std::size_t i = 0; i < record.scans.size(); ++i) {
    const auto now = boats_at(record.truth, static_cast<std::int64_t>(i));
    if (!config.initiate) start_new(now, before, next, tracker, own);
    tracker.step(scans.at(i), log);
    before = now;
  }
  tracker.finish(log);
  BoatScore score;
  const auto last = static_cast<std::int64_t>(record.scans.size()) - 1;
  judge_last(before, log.at(last), own, score);
  const auto in_reach = [&](std::vector<TrackPoint> points) {
    std::erase_if(points, [&](const TrackPoint& p) {
      return distance({p.x, p.y}, record.scans[static_cast<std::size_t>(p.frame)].ship) > reach;
    });
    return points;
  };
  const std::vector<TrackPoint> revised = in_reach(log.revised());
  const EvaluationOptions options{.cutoff = kBoatCutoff, .frames = last + 1};
  const std::vector<TrackPoint> online = in_reach(log.online());
  score.scores = evaluate(record.truth, online, options);
  score.confirmed = first_confirmed(online, score.scores);
  for (const auto& [id, ignored] : score.scores.truths) {
    score.coverage[id] = coverage_of(id, record.truth, revised, options);
  }
  return score;
}

}  // namespace glint
