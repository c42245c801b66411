// SPDX-License-Identifier: Apache-2.0
#include "glint/experiments/point_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "glint/engine/metrics/evaluation.hpp"

namespace glint {
namespace {

constexpr double kLost = 14;  // [px]: half a validation gate of the paper
constexpr int kLostFor = 3;   // frames in a row

/// Errors of one target, as they come.
class Score {
 public:
  void predicted(double error) {
    sum_ += error, ++count_;
    far_ = error > kLost ? far_ + 1 : 0;
    lost_ = lost_ || far_ >= kLostFor;
  }
  void estimated(const TruthPoint& truth, const TrackPoint& reported) {
    estimates_ += std::hypot(reported.x - truth.x, reported.y - truth.y);
    target_.normalised.push_back((reported.x - truth.x) / std::sqrt(reported.var_x));
    target_.normalised.push_back((reported.y - truth.y) / std::sqrt(reported.var_y));
  }
  FollowedTarget result() const {
    FollowedTarget target = target_;
    target.prediction_error = sum_ / count_, target.estimation_error = estimates_ / count_;
    target.lost = lost_ || far_ > 0;
    return target;
  }

 private:
  FollowedTarget target_;
  double sum_ = 0, estimates_ = 0;
  int count_ = 0, far_ = 0;
  bool lost_ = false;
};

template <class T>
void start_on_two_points(T& tracker, const Scene& scene, const PointSensor& sensor,
                         std::uint64_t seed) {
  const auto first = truth_at(scene, 0), second = truth_at(scene, 1);
  for (std::size_t s = 0; s < first.size(); ++s) {
    const PointMeasurement a = point_of(first[s], sensor, seed),
                           b = point_of(second[s], sensor, seed);
    tracker.start(b.x, b.y, b.x - a.x, b.y - a.y);
  }
}

template <class T, class Config>
FollowedRun follow(const Scene& scene, const PointSensor& sensor, const Config& config,
                   std::uint64_t seed) {
  T tracker(config, Device::tbb(1), seed);
  start_on_two_points(tracker, scene, sensor, seed);
  std::vector<Score> scores(scene.targets.size());
  TrackLog log;
  for (int frame = 1; frame < scene.frames; ++frame) {
    const std::vector<PointMeasurement> points = points_at(scene, sensor, seed, frame);
    Scan scan;
    scan.frame = frame, scan.time = frame * scene.interval, scan.points = points;
    tracker.step(scan, log);
    if (frame == 1) continue;
    const auto reported = log.at(frame);
    for (const TruthPoint& truth : truth_at(scene, frame)) {
      const auto s = static_cast<std::size_t>(truth.track_id);  // tracks are in the same order
      const ExpectedPlace& expected = tracker.expected()[s];
      scores[s].predicted(std::hypot(expected.x - truth.x, expected.y - truth.y));
      scores[s].estimated(truth, reported[s]);
    }
  }
  FollowedRun targets;
  for (const Score& score : scores) targets.push_back(score.result());
  return targets;
}

}  // namespace

FollowedRun follow_points(const Scene& scene, const PointSensor& sensor, const PmhtConfig& config,
                          std::uint64_t seed) {
  return follow<Pmht>(scene, sensor, config, seed);
}

FollowedRun follow_points(const Scene& scene, const PointSensor& sensor,
                          const MmpfPmhtConfig& config, std::uint64_t seed) {
  return follow<MmpfPmht>(scene, sensor, config, seed);
}

void start_on_targets(PmhtConfig& config, double clutter_density) {
  constexpr double kNone = 1e-9;  // [1/px^2]
  keep_to_known(config);
  config.clutter_density = clutter_density > 0 ? clutter_density : kNone;
}

namespace {

std::vector<double> errors(const std::vector<FollowedRun>& runs, std::size_t target,
                           double FollowedTarget::*error) {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const FollowedRun& run : runs) {
    values.push_back(run[target].lost ? kUndefined : run[target].*error);
  }
  return values;
}

}  // namespace

std::vector<double> prediction_errors(const std::vector<FollowedRun>& runs, std::size_t target) {
  return errors(runs, target, &FollowedTarget::prediction_error);
}

std::vector<double> estimation_errors(const std::vector<FollowedRun>& runs, std::size_t target) {
  return errors(runs, target, &FollowedTarget::estimation_error);
}

std::vector<double> lost_shares(const std::vector<FollowedRun>& runs) {
  std::vector<double> shares;
  for (const FollowedRun& run : runs) {
    const auto lost = static_cast<double>(std::ranges::count_if(run, &FollowedTarget::lost));
    shares.push_back(100 * lost / static_cast<double>(run.size()));
  }
  return shares;
}

}  // namespace glint
