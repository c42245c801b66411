// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "glint/engine/scenario/scenes.hpp"
#include "glint/experiments/monte_carlo.hpp"
#include "glint/experiments/pmht.hpp"
#include "glint/experiments/point_run.hpp"

namespace glint {
namespace {

constexpr std::array kClips{"bs44", "bs49", "bs50"};
constexpr std::size_t kTargets = 2;  // a clip

struct Line {
  const char* name;
  int particles;
  double percent;                                      // clutter
  std::array<double, kClips.size() * kTargets> paper;  // [px]
  std::array<double, kClips.size()> attained;          // prediction error, both targets [px]
  double tolerance;                                    // [px]
  double most_lost;                                    // [%]
};

/// Attained figures are means of 30 runs; the tolerance is 3 standard errors of a difference of two
/// such means.
constexpr std::array kLines{
    Line{"200 particles",
         200,
         0,
         {.7797, .7265, .8568, 1.0127, .6755, .6286},
         {2.08, 2.64, 2.87},
         0.2,
         3},
    Line{"200 particles, .03 %",
         200,
         0.03,
         {1.3119, 1.8121, .9441, 1.0073, .9609, 1.7737},
         {2.56, 3.08, 3.26},
         0.3,
         12},
    Line{"1000 particles",
         1000,
         0,
         {.7797, .7265, .8568, 1.0127, .6755, .6286},
         {1.70, 1.96, 2.27},
         0.2,
         3},
};

FollowedRun follow(const Line& line, const char* clip, std::uint64_t seed) {
  PmhtClipScene config;
  config.clip = clip;
  const Scene scene = make_scene(config);
  PointSensor sensor;
  sensor.clutter = PointSensor::clutter_of(scene, line.percent);
  MmpfPmhtConfig tracker;
  start_on_targets(tracker, sensor.clutter_density(scene));
  tracker.particles = line.particles;
  return follow_points(scene, sensor, tracker, seed);
}

/// Mean of the two columns, of what is not lost.
std::vector<double> both(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> means;
  for (std::size_t r = 0; r < a.size(); ++r)
    means.push_back(summarise(std::array{a[r], b[r]}).mean);
  return means;
}

void add_rows(const Line& line, std::size_t clip, const std::vector<FollowedRun>& runs,
              ExperimentResult& result) {
  const std::string name = std::string(line.name) + ", " + kClips[clip];
  for (std::size_t t = 0; t < kTargets; ++t) {
    result.rows.push_back(value_row(name, "target " + std::to_string(t + 1) + " [px]",
                                    prediction_errors(runs, t), {},
                                    line.paper[clip * kTargets + t]));
  }
  const double attained = line.attained[clip];
  result.rows.push_back(value_row(name, "prediction [px]",
                                  both(prediction_errors(runs, 0), prediction_errors(runs, 1)),
                                  Band{{}, attained + line.tolerance}));
  result.rows.push_back(value_row(name, "estimate [px]",
                                  both(estimation_errors(runs, 0), estimation_errors(runs, 1))));
}

}  // namespace

ExperimentResult run_mmpf_table_a(const ExperimentOptions& options, Workers& workers) {
  const auto runs = run_cases(kLines.size() * kClips.size(), options, workers,
                              [&](std::size_t which, std::size_t run) {
                                return follow(kLines[which / kClips.size()],
                                              kClips[which % kClips.size()], options.seed + run);
                              });
  ExperimentResult result;
  for (std::size_t line = 0; line < kLines.size(); ++line) {
    std::vector<double> lost;
    for (std::size_t clip = 0; clip < kClips.size(); ++clip) {
      const auto& of_clip = runs[line * kClips.size() + clip];
      add_rows(kLines[line], clip, of_clip, result);
      const std::vector<double> shares = lost_shares(of_clip);
      lost.insert(lost.end(), shares.begin(), shares.end());
    }
    result.rows.push_back(
        value_row(kLines[line].name, "targets lost [%]", lost, Band{{}, kLines[line].most_lost}));
  }
  return result;
}

}  // namespace glint
