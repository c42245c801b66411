// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "glint/engine/metrics/metrics.hpp"
#include "glint/engine/number_text.hpp"
#include "glint/engine/scenario/radar_scenes.hpp"
#include "glint/experiments/boat_tracker.hpp"
#include "glint/experiments/jpda.hpp"
#include "glint/experiments/monte_carlo.hpp"

namespace glint {
namespace {

constexpr double kCutoff = 20, kOrder = 2;  // of OSPA [m]

constexpr std::array kReadings{
    JpdaReading{"single scan", 1, WindowReading::best}, JpdaReading{"A", 2, WindowReading::restart},
    JpdaReading{"C", 2, WindowReading::sliding}, JpdaReading{"C*", 2, WindowReading::best},
    JpdaReading{"C*, three scans", 3, WindowReading::best}};
constexpr std::array kPartings{0.3, 1.2};  // [m/s]
constexpr std::size_t kPlain = 2, kBest = 3;

struct Run {
  double merged = 0, after = 0;  ///< mean OSPA while there is one echo, and later [m]
  double since = 0;              ///< over both
  double lost = 0, swapped = 0;  ///< 1 or 0, at the end
};

struct Case {
  JpdaReading reading;
  double parting;  // [m/s]
};

std::vector<PointMeasurement> echoes(const RadarScene& scene, std::uint64_t seed, int scan) {
  std::vector<PointMeasurement> points;
  for (const Eigen::Vector3d& p : points_at(scene, seed, scan))
    points.push_back({p.x(), p.y(), 10});
  return points;
}

Run follow(const Case& c, std::uint64_t seed) {
  MergingBoatsScene settings;
  settings.parting = c.parting;
  const RadarScene scene = make_scene(settings);
  ImmJpdaConfig config = boat_tracker(c.reading);
  keep_to_known(config);
  ImmJpda tracker(config, Device::serial(), seed);
  for (const TruthPoint& boat : truth_at(scene, 0)) {
    tracker.start(boat.x, boat.y, boat.vx, boat.vy);
  }
  TrackLog log;
  Run run;
  int merged = 0, after = 0;
  for (int k = 0; k < scene.scans; ++k) {
    const std::vector<PointMeasurement> points = echoes(scene, seed, k);
    Scan scan;
    scan.frame = k, scan.time = k * scene.interval, scan.points = points;
    tracker.step(scan, log);
    std::vector<Position> tracks, truth;
    for (const TrackPoint& p : log.at(k)) tracks.push_back({p.x, p.y});
    for (const TruthPoint& p : truth_at(scene, k)) truth.push_back({p.x, p.y});
    const double error = ospa(truth, tracks, kCutoff, kOrder).distance;
    if (scan.time >= settings.part) run.after += error, ++after;
    if (scan.time >= settings.merge && scan.time < settings.part) run.merged += error, ++merged;
    const auto off = [&](std::size_t a, std::size_t b) {  // the larger, as labelled or exchanged
      return std::max(std::hypot(tracks[0].x - truth[a].x, tracks[0].y - truth[a].y),
                      std::hypot(tracks[1].x - truth[b].x, tracks[1].y - truth[b].y));
    };
    run.swapped = off(1, 0) < off(0, 1);
    run.lost = std::min(off(0, 1), off(1, 0)) > kCutoff;
  }
  run.since = (run.merged + run.after) / (merged + after);
  run.merged /= merged, run.after /= after;
  return run;
}

/// What a Monte Carlo mean must keep to: C* does, and C, which the same band must tell from it,
/// does not.
constexpr double kMost = 7.5;  // [m]

void add_rows(const Case& c, const std::vector<Run>& runs, ExperimentResult& result) {
  const std::string name = std::string(c.reading.name) + ", parting at " + number_text(c.parting);
  const auto row = [&](const char* metric, double scale, double Run::*of,
                       std::optional<Band> band = {}) {
    result.rows.push_back(value_row(name, metric, column(runs, of, scale), band));
  };
  const bool best = c.reading.name == kReadings[kBest].name;
  const bool plain = c.reading.name == kReadings[kPlain].name;
  std::optional<Band> band;
  if (best) band = Band{{}, kMost};
  if (plain) band = Band{kMost + 0.5, {}};
  row("OSPA while merged [m]", 1, &Run::merged);
  row("OSPA after [m]", 1, &Run::after);
  row("OSPA since the merge [m]", 1, &Run::since, band);
  row("runs lost [%]", 100, &Run::lost, best ? std::optional(Band{{}, 0}) : std::nullopt);
  row("labels exchanged [%]", 100, &Run::swapped);
}

}  // namespace

ExperimentResult run_jpda_coalescence(const ExperimentOptions& options, Workers& workers) {
  std::vector<Case> cases;
  for (const double parting : kPartings) {
    for (const JpdaReading& reading : kReadings) cases.push_back({reading, parting});
  }
  const auto runs = run_cases(
      cases.size(), options, workers,
      [&](std::size_t which, std::size_t run) { return follow(cases[which], options.seed + run); });
  ExperimentResult result;
  for (std::size_t i = 0; i < cases.size(); ++i) add_rows(cases[i], runs[i], result);
  return result;
}

}  // namespace glint
