// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "glint/engine/number_text.hpp"
#include "glint/engine/scenario/scenes.hpp"
#include "glint/experiments/figures.hpp"
#include "glint/experiments/monte_carlo.hpp"
#include "glint/experiments/phd.hpp"
#include "glint/experiments/phd_settings.hpp"
#include "glint/experiments/scene_run.hpp"

namespace glint {
namespace {

constexpr std::array kTrackers{"mm-phd", "smc-phd", "mm-pf"};
constexpr double kReach = 3;  // a confirmed point this near is the target's [px]

struct Level {
  double snr;                     // [dB]
  double detected, false_tracks;  // what mm-phd must reach: share of frames; a run
};
constexpr std::array kLevels{Level{12, .82, .1}, Level{6, .75, .1}, Level{3, .5, .1}};

struct DimRun {
  double detected = 0, delay = kUndefined, ospa = 0, false_tracks = 0;
};
auto fields(OneOf<DimRun> auto& r) { return std::tie(r.detected, r.delay, r.ospa, r.false_tracks); }

DimRun run_of(const Level& level, const char* tracker, std::uint64_t seed) {
  DimTargetScene config;
  config.snr = level.snr, config.variant = static_cast<int>(seed);
  const SceneRun run = run_scene(make_scene(config), phd::dim_target_setup(tracker), seed);
  const std::vector<double>& error = run.online.targets.front().error;
  DimRun result;
  double there = 0;
  for (std::size_t k = 0; k < error.size(); ++k) {
    there += run.targets[k];
    if (!(error[k] <= kReach)) continue;
    ++result.detected;
    if (std::isnan(result.delay)) result.delay = there - 1;
  }
  result.detected /= there;
  result.ospa = run.online.scores.mean_ospa.distance;
  result.false_tracks = static_cast<double>(run.online.scores.false_tracks);
  return result;
}

/// Confirmed tracks in white noise, for 2000 frames.
double tracks_in_noise(const char* tracker, std::uint64_t seed) {
  NoiseScene config;
  config.width = config.height = 64, config.frames = 100;
  const SceneRun run = run_scene(make_scene(config), phd::dim_target_setup(tracker), seed);
  return 2000.0 / config.frames * static_cast<double>(run.online.scores.false_tracks);
}

void add_rows(const Level& level, const char* tracker, const std::vector<DimRun>& runs,
              ExperimentResult& result) {
  const bool banded = tracker == kTrackers.front();
  const std::string name = std::string(tracker) + ", " + number_text(level.snr) + " dB";
  const auto band = [&](std::optional<double> low, std::optional<double> high) {
    return banded ? std::optional(Band{low, high}) : std::nullopt;
  };
  result.rows.push_back(
      value_row(name, "detected", column(runs, &DimRun::detected), band(level.detected, {})));
  result.rows.push_back(
      value_row(name, "first detected after [frames]", column(runs, &DimRun::delay)));
  result.rows.push_back(value_row(name, "OSPA [px]", column(runs, &DimRun::ospa)));
  result.rows.push_back(value_row(name, "false tracks", column(runs, &DimRun::false_tracks),
                                  band({}, level.false_tracks)));
}

}  // namespace

ExperimentResult run_dim_target(const ExperimentOptions& options, Workers& workers) {
  constexpr std::size_t kPer = kLevels.size() + 1;  // cases a tracker; the last is noise alone
  const auto runs =
      run_cases(kTrackers.size() * kPer, options, workers, [&](std::size_t which, std::size_t run) {
        const char* tracker = kTrackers[which / kPer];
        const std::size_t level = which % kPer;
        const std::uint64_t seed = options.seed + run;
        if (level < kLevels.size()) return run_of(kLevels[level], tracker, seed);
        return DimRun{.false_tracks = tracks_in_noise(tracker, seed)};
      });
  ExperimentResult result;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const char* tracker = kTrackers[i / kPer];
    const std::size_t level = i % kPer;
    if (level < kLevels.size()) {
      add_rows(kLevels[level], tracker, runs[i], result);
    } else {
      result.rows.push_back(value_row(std::string(tracker) + ", noise alone",
                                      "tracks in 2000 frames",
                                      column(runs[i], &DimRun::false_tracks),
                                      i < kPer ? std::optional(Band{{}, 1}) : std::nullopt));
    }
  }
  return result;
}

}  // namespace glint
