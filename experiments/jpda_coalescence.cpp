// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "glint/engine/metrics/metrics.hpp"
#include "glint/experiments/boat_tracker.hpp"
#include "glint/experiments/jpda.hpp"
#include "glint/experiments/monte_carlo.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

// A radar that turns once in 2.5 s sees two boats side by side; for 45 s both are one echo, where
// the second is.
constexpr double kPeriod = 2.5, kMerge = 30, kPart = 75, kEnd = 135;  // [s]
constexpr double kSpeed = 3, kApart = 20, kSigma = 5;                 // [m/s], [m], [m]
constexpr double kDetection = 0.9;
constexpr double kCutoff = 20, kOrder = 2;  // of OSPA [m]

constexpr std::array kReadings{
    JpdaReading{"single scan", 1, WindowReading::best}, JpdaReading{"A", 2, WindowReading::restart},
    JpdaReading{"C", 2, WindowReading::sliding}, JpdaReading{"C*", 2, WindowReading::best},
    JpdaReading{"C*, three scans", 3, WindowReading::best}};
constexpr std::size_t kBest = 3;

struct Run {
  double merged = 0, after = 0;  ///< mean OSPA while there is one echo, and later [m]
  double lost = 0, swapped = 0;  ///< 1 or 0, at the end
};

std::vector<PointMeasurement> echoes(double time, int scan, std::uint64_t seed) {
  const RandomKey key = random_key(seed, static_cast<std::uint64_t>(scan), Purpose::scenario);
  const bool one = time >= kMerge && time < kPart;
  std::vector<PointMeasurement> points;
  for (std::uint32_t target = one ? 1 : 0; target < 2; ++target) {
    const auto seen = static_cast<double>(uniform(random_words(key, target, 1).w[0]));
    if (seen > kDetection) continue;
    const Normals4 n = random_normals(key, target);
    const double x = kSpeed * time + kSigma * static_cast<double>(n.n[0]);
    const double y = kApart * target + kSigma * static_cast<double>(n.n[1]);
    points.push_back({x, y, 10});
  }
  return points;
}

Run follow(const JpdaReading& reading, std::uint64_t seed) {
  ImmJpdaConfig config = boat_tracker(reading);
  keep_to_known(config);
  ImmJpda tracker(config, Device::serial(), seed);
  for (const double y : {0.0, kApart}) tracker.start(0, y, kSpeed, 0);
  TrackLog log;
  Run run;
  int merged = 0, after = 0;
  for (int k = 0; k * kPeriod < kEnd; ++k) {
    const double time = k * kPeriod;
    const std::vector<PointMeasurement> points = echoes(time, k, seed);
    Scan scan;
    scan.frame = k, scan.time = time, scan.points = points;
    tracker.step(scan, log);
    std::vector<Position> tracks;
    for (const TrackPoint& p : log.at(k)) tracks.push_back({p.x, p.y});
    const std::array truth{Position{kSpeed * time, 0}, Position{kSpeed * time, kApart}};
    const double error = ospa(truth, tracks, kCutoff, kOrder).distance;
    if (time >= kPart) run.after += error, ++after;
    if (time >= kMerge && time < kPart) run.merged += error, ++merged;
    const auto off = [&](std::size_t a, std::size_t b) {  // the larger, as labelled or exchanged
      return std::max(std::hypot(tracks[0].x - truth[a].x, tracks[0].y - truth[a].y),
                      std::hypot(tracks[1].x - truth[b].x, tracks[1].y - truth[b].y));
    };
    run.swapped = off(1, 0) < off(0, 1);
    run.lost = std::min(off(0, 1), off(1, 0)) > kCutoff;
  }
  run.merged /= merged, run.after /= after;
  return run;
}

}  // namespace

ExperimentResult run_jpda_coalescence(const ExperimentOptions& options, Workers& workers) {
  const auto runs =
      run_cases(kReadings.size(), options, workers, [&](std::size_t which, std::size_t run) {
        return follow(kReadings[which], options.seed + run);
      });
  ExperimentResult result;
  for (std::size_t r = 0; r < kReadings.size(); ++r) {
    std::vector<double> merged, after, since, lost, swapped;
    for (const Run& run : runs[r]) {
      merged.push_back(run.merged), after.push_back(run.after);
      const double share = (kPart - kMerge) / (kEnd - kMerge);
      since.push_back(share * run.merged + (1 - share) * run.after);
      lost.push_back(100 * run.lost), swapped.push_back(100 * run.swapped);
    }
    const bool best = r == kBest;
    const auto band = [&](double high) {
      return best ? std::optional(Band{{}, high}) : std::nullopt;
    };
    result.rows.push_back(value_row(kReadings[r].name, "OSPA while merged [m]", merged));
    result.rows.push_back(value_row(kReadings[r].name, "OSPA after [m]", after));
    result.rows.push_back(
        value_row(kReadings[r].name, "OSPA since the merge [m]", since, band(8.6)));
    result.rows.push_back(value_row(kReadings[r].name, "runs lost [%]", lost, band(0)));
    result.rows.push_back(value_row(kReadings[r].name, "labels exchanged [%]", swapped));
  }
  return result;
}

}  // namespace glint
