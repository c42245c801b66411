// SPDX-License-Identifier: Apache-2.0
#include "glint/experiments/figures.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "glint/engine/scenario/scenario.hpp"
#include "glint/experiments/condition.hpp"
#include "glint/experiments/monte_carlo.hpp"
#include "glint/experiments/runs.hpp"

namespace glint {
namespace {

/// A run with so many targets a frame, and its OSPA in the online record.
SceneRun run_of(std::vector<int> targets, const std::vector<double>& ospa) {
  SceneRun run;
  run.targets = std::move(targets);
  for (const double distance : ospa) run.online.scores.ospa.push_back({distance, 0, 0});
  return run;
}

TEST(Figures, OspaIsOfFramesWithATargetOrOfEmptyOnesButForTwoAfterIt) {
  const SceneRun run = run_of({0, 1, 2, 0, 0, 0, 0}, {8, 1, 3, 16, 32, 4, 6});
  EXPECT_EQ(ospa_while_present(run, &SceneRun::online), 2);
  EXPECT_EQ(ospa_while_empty(run, &SceneRun::online), 6);  // of 8, 4 and 6
}

TEST(Figures, RmseIsOverAllPointsOfAllTargets) {
  SceneRun run;
  run.revised.targets = {{{3, kUndefined, 4}, {}}, {{5}, {}}};
  EXPECT_DOUBLE_EQ(rmse(run, &SceneRun::revised), std::sqrt((9 + 16 + 25) / 3.0));
}

TEST(Figures, FramesCountFromOne) {
  SceneRun run;
  TruthScore truth;
  truth.first = 4, truth.detect_delay = 3;
  run.online.scores.truths[0] = truth;
  run.online.targets = {{{}, {}, 20}};
  EXPECT_EQ(confirmed_at(run, 0), 8);
  EXPECT_EQ(halted_at(run, 0), 21);
  EXPECT_TRUE(std::isnan(confirmed_at(run, 1)));
}

TEST(Figures, SharesAreInPercentAndFalseTracksInAHundredRuns) {
  SceneRun run;
  run.revised.scores.track_detection_probability = 0.75;
  run.revised.scores.false_tracks = 2;
  run.revised.scores.truths[1].detected = true, run.revised.scores.truths[2].detected = false;
  EXPECT_EQ(detected_targets(run, &SceneRun::revised), 75);
  EXPECT_EQ(false_tracks_in_100(run, &SceneRun::revised), 200);
  EXPECT_EQ(target_detected(run, &SceneRun::revised, 1), 100);
  EXPECT_EQ(target_detected(run, &SceneRun::revised, 2), 0);
  EXPECT_TRUE(std::isnan(target_detected(run, &SceneRun::revised, 0)));
}

TEST(Condition, AGainIsByHowMuchTheOtherIsAboveSeedBySeed) {
  const Figure figure{
      "OSPA",
      [](const SceneRun& run) { return ospa_while_present(run, &SceneRun::online); },
      {},
      Band{0.2, {}}};
  const Runs ours{run_of({1}, {1}), run_of({1}, {2})}, than{run_of({1}, {2}), run_of({1}, {7})};
  const ExperimentRow row = gain_row("a", figure, ours, than);
  EXPECT_EQ(row.ours, 3);  // of 1 and 5
  EXPECT_DOUBLE_EQ(row.spread, std::sqrt(8.0));
  EXPECT_TRUE(*row.inside());
}

TEST(Condition, CurvesAreMeansOverRunsAndRootsOfMeanSquares) {
  Runs runs{run_of({1, 1}, {1, 2}), run_of({1, 1}, {3, 6})};
  runs[0].online.targets = {{{3, 1}, {}}}, runs[1].online.targets = {{{4, kUndefined}, {}}};
  const auto ospa = [](const SceneRun& r, std::size_t k) {
    return r.online.scores.ospa[k].distance;
  };
  const Curve mean = mean_curve("", "c", "ospa", runs, ospa);
  EXPECT_EQ(mean.frame, (std::vector<double>{1, 2}));
  EXPECT_EQ(mean.value, (std::vector<double>{2, 4}));
  const Curve rms = rmse_curve("", "c", runs, &SceneRun::online, 0);
  EXPECT_DOUBLE_EQ(rms.value[0], std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(rms.value[1], 1);
}

/// A bright target in frames 3 to 14 of 30.
Scene bright_scene() {
  Scene scene;
  scene.width = scene.height = 40, scene.frames = 30;
  scene.point_spread = PointSpread::of(0.7);
  scene.targets = {{3, 15, scene.point_spread.intensity_of_snr(22), fly({8, 10, 0.9, 0.4})}};
  return scene;
}

TEST(SceneRun, ATrackEndsWhereItsTrackerSaysSoOrBehindItsLastPoint) {
  const TrackerSetup setup{"viterbi", {{"psf_sigma", 0.7}, {"snr_low", 20.0}, {"snr_high", 24.0}}};
  const SceneRun run = run_scene(bright_scene(), setup, 1);
  EXPECT_EQ(run.targets[2], 0);
  EXPECT_EQ(run.targets[3], 1);
  EXPECT_EQ(run.targets[15], 0);
  EXPECT_EQ(run.online.targets[0].halted, 18);   // four frames after the last point, at 14
  EXPECT_EQ(run.revised.targets[0].halted, 15);  // where that is taken back
  EXPECT_LT(run.revised.targets[0].error[14], 1.5);
  EXPECT_TRUE(std::isnan(run.revised.targets[0].error[15]));
}

/// Keeps what it is given.
struct Memory : RunStore {
  std::optional<std::string> find(RunId id) override {
    const auto found = kept.find(id);
    return found == kept.end() ? std::nullopt : std::optional(found->second);
  }
  void keep(RunId id, const std::string& bytes) override { kept[id] = bytes; }
  std::map<RunId, std::string> kept;
};

TEST(Runs, OfAStoreAreNotMadeAgain) {
  Memory memory;
  ExperimentOptions options;
  options.runs = 3, options.store = &memory;
  Workers workers(2);
  std::atomic<int> made = 0;
  const auto run = [&] {
    return run_cases(2, options, workers, [&](std::size_t which, std::size_t r) {
      ++made;
      return 10.0 * static_cast<double>(which) + static_cast<double>(r);
    });
  };
  const auto first = run();
  EXPECT_EQ(made, 6);
  EXPECT_EQ(first, (std::vector<std::vector<double>>{{0, 1, 2}, {10, 11, 12}}));
  EXPECT_EQ(memory.kept.size(), 6u);
  EXPECT_EQ(run(), first);
  EXPECT_EQ(made, 6);
  memory.kept.erase({1, 2});
  EXPECT_EQ(run(), first);
  EXPECT_EQ(made, 7);
}

}  // namespace
}  // namespace glint
