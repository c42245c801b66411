// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "glint/engine/scenario/scenes.hpp"
#include "glint/experiments/monte_carlo.hpp"
#include "glint/experiments/phd.hpp"
#include "glint/experiments/phd_settings.hpp"
#include "glint/experiments/scene_run.hpp"

namespace glint {
namespace {

constexpr std::array kTrackers{"mm-phd", "mm-pf", "smc-phd", "viterbi", "h-pmht"};
constexpr double kReach = 3;  // [px]

struct FieldRun {
  double detected = 0, ospa = 0, false_points = 0, false_tracks = 0;
};
auto fields(OneOf<FieldRun> auto& r) {
  return std::tie(r.detected, r.ospa, r.false_points, r.false_tracks);
}

TrackerSetup setup_of(const std::string& tracker) {
  if (tracker == "h-pmht") return {tracker, {}};
  return phd::dim_target_setup(tracker);
}

FieldRun run_of(const char* tracker, const ExperimentOptions& options, std::uint64_t seed) {
  DimFieldScene config;
  config.variant = static_cast<int>(seed);
  SceneRunOptions of_run;
  of_run.device = options.device;
  const Scene scene = make_scene(config);
  const SceneRun run = run_scene(scene, setup_of(tracker), seed, of_run);
  FieldRun result;
  double there = 0;
  for (const int targets : run.targets) there += targets;
  for (const TargetRecord& target : run.online.targets) {
    for (const double error : target.error) result.detected += error <= kReach ? 1 : 0;
  }
  result.detected /= there;
  result.ospa = run.online.scores.mean_ospa.distance;
  result.false_points = run.online.scores.false_points_per_frame;
  result.false_tracks = run.online.scores.false_tracks;
  return result;
}

std::optional<Band> band_of(const std::string& tracker) {
  return tracker == "mm-pf" ? std::optional(Band{.6, {}}) : std::nullopt;
}

}  // namespace

ExperimentResult run_dim_field(const ExperimentOptions& options, Workers& workers) {
  const auto runs =
      run_cases(kTrackers.size(), options, workers, [&](std::size_t which, std::size_t run) {
        return run_of(kTrackers[which], options, options.seed + run);
      });
  ExperimentResult result;
  for (std::size_t t = 0; t < kTrackers.size(); ++t) {
    const std::string name = kTrackers[t];
    const auto add = [&](const char* metric, double FieldRun::*of, std::optional<Band> band) {
      result.rows.push_back(value_row(name, metric, column(runs[t], of), band));
    };
    add("detected", &FieldRun::detected, band_of(name));
    add("OSPA [px]", &FieldRun::ospa, {});
    add("false points a frame", &FieldRun::false_points, {});
    add("false tracks", &FieldRun::false_tracks, {});
  }
  return result;
}

}  // namespace glint
