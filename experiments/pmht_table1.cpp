// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "glint/engine/scenario/scenes.hpp"
#include "glint/experiments/monte_carlo.hpp"
#include "glint/experiments/pmht.hpp"
#include "glint/experiments/point_run.hpp"

namespace glint {
namespace {

constexpr std::array kClips{"bs44", "bs49", "bs50"};
constexpr std::size_t kTargets = 2;  // a clip

/// By clip, then by target; missing where the paper prints "fails", or all are lost.
using Errors = std::array<std::optional<double>, kClips.size() * kTargets>;

constexpr std::nullopt_t kNone = std::nullopt;

/// A line of the table: how points come, and how they are followed.
struct Line {
  std::string name;
  const char* motion;
  PmhtAssociation association;
  double variance, percent;  ///< of the points: noise besides rounding [px^2]; clutter
  Errors paper{};
  Errors attained{};           ///< by a right implementation
  double tolerance = 0;        ///< [px]
  std::optional<Band> lost{};  ///< [%]
};

/// Attained figures are means of 100 runs. Without noise and clutter every run is the same, and
/// the tolerance is that of rounding; else it is 3 standard errors of a difference of two means,
/// and the share of lost targets may be 2 standard errors above.
std::vector<Line> lines() {
  const char* two = "ca+singer";
  constexpr PmhtAssociation mixture = PmhtAssociation::mixture, own = PmhtAssociation::per_model;
  const Errors quiet{1.8523, 3.3542, 3.2662, 3.0113, 3.0710, 3.1088};
  const Errors clutter{2.6126, kNone, 3.7474, 5.2833, 3.3174, 3.7897};
  return {
      {"rounded, mixture",
       two,
       mixture,
       0,
       0,
       quiet,
       {2.74, 2.56, 1.99, 1.97, 2.31, 2.22},
       0.01,
       Band{{}, 0}},
      {"rounded, per model",
       two,
       own,
       0,
       0,
       quiet,
       {2.74, 2.56, 1.99, 1.97, 2.31, 2.22},
       0.04,
       Band{{}, 0}},
      {"rounded, pmht-ca",
       "ca",
       own,
       0,
       0,
       {1.9650, 3.4995, 4.9959, 5.1730, kNone, 5.7795},
       {2.89, 2.92, 4.93, 5.09, kNone, kNone},
       0.01,
       Band{33, 34}},
      {"rounded, pmht-singer",
       "singer",
       own,
       0,
       0,
       {kNone, kNone, 1.9257, 2.1353, 2.3164, 2.1093},
       {1.02, 0.94, 1.57, 1.62, 2.02, 1.91},
       0.01,
       Band{{}, 0}},
      {"rounded, .02 %, per model",
       two,
       own,
       0,
       0.02,
       {2.2849, kNone, 3.4328, 3.1441, 3.3201, 3.6560},
       {},
       0,
       Band{{}, 2.5}},
      // Two levels of noise are no substitute for two models: the figure must tell them apart.
      {"rounded, .02 %, pmht-homothetic", "ca+ca", own, 0, 0.02, {}, {}, 0, Band{3, {}}},
      {"rounded, .03 %, mixture",
       two,
       mixture,
       0,
       0.03,
       clutter,
       {3.07, 3.01, 2.47, 2.48, 2.73, 2.70},
       0.11,
       Band{{}, 7.4}},
      {"rounded, .03 %, per model", two, own, 0, 0.03, clutter, {}, 0, Band{{}, 3.7}},
      {"noisy, mixture",
       two,
       mixture,
       2,
       0,
       {},
       {3.31, 3.27, 3.03, 3.00, 3.17, 3.06},
       0.1,
       Band{{}, 1}},
      {"noisy, .03 %, mixture",
       two,
       mixture,
       2,
       0.03,
       {},
       {3.62, 3.80, 3.41, 3.41, 3.48, 3.47},
       0.16,
       Band{{}, 24}},
      {"noisy, .03 %, per model", two, own, 2, 0.03, {}, {}, 0, Band{{}, 12.8}},
  };
}

FollowedRun follow(const Line& line, const char* clip, std::uint64_t seed) {
  PmhtClipScene config;
  config.clip = clip;
  const Scene scene = make_scene(config);
  PointSensor sensor;
  sensor.variance = line.variance;
  sensor.clutter = PointSensor::clutter_of(scene, line.percent);
  PmhtConfig tracker;
  start_on_targets(tracker, sensor.clutter_density(scene));
  tracker.motion = line.motion, tracker.association = line.association;
  return follow_points(scene, sensor, tracker, seed);
}

/// The targets of all clips in one.
FollowedRun follow_all(const Line& line, std::uint64_t seed) {
  FollowedRun all;
  for (const char* clip : kClips) {
    FollowedRun run = follow(line, clip, seed);
    std::move(run.begin(), run.end(), std::back_inserter(all));
  }
  return all;
}

void add_rows(const Line& line, const std::vector<FollowedRun>& runs, ExperimentResult& result) {
  for (std::size_t t = 0; t < kClips.size() * kTargets; ++t) {
    const std::string target =
        std::string(kClips[t / kTargets]) + " target " + std::to_string(t % kTargets + 1) + " [px]";
    std::optional<Band> band;
    if (const auto& at = line.attained[t]) band = Band{*at - line.tolerance, *at + line.tolerance};
    result.rows.push_back(
        value_row(line.name, target, prediction_errors(runs, t), band, line.paper[t]));
  }
  result.rows.push_back(value_row(line.name, "targets lost [%]", lost_shares(runs), line.lost));
}

}  // namespace

ExperimentResult run_pmht_table_1(const ExperimentOptions& options, Workers& workers) {
  const std::vector<Line> all = lines();
  const auto runs =
      run_cases(all.size(), options, workers, [&](std::size_t which, std::size_t run) {
        return follow_all(all[which], options.seed + run);
      });
  ExperimentResult result;
  for (std::size_t i = 0; i < all.size(); ++i) add_rows(all[i], runs[i], result);
  return result;
}

}  // namespace glint
