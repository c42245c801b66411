// SPDX-License-Identifier: Apache-2.0
// Trackers of frames and of points on one stream: each one's log is the one of its run alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "glint/engine/scenario/scenes.hpp"
#include "glint/engine/trackers/registry.hpp"
#include "glint/experiments/log_parity.hpp"

namespace glint {
namespace {

using Names = std::vector<std::string>;
constexpr std::uint64_t kSeed = 3;

// Points come from the frames, by a threshold that lets false ones through.
std::vector<std::string> logs_of(const Names& names, const Device& device) {
  IrClipScene clip;
  clip.frames = 30;
  PointsConfig points;
  points.threshold = 4;
  Scheduler scheduler(device, FramePreparer(FramesConfig{}, device), points);
  for (const std::string& name : names) {
    const TrackerEntry& entry = find_tracker(name);
    scheduler.add(entry.make(entry.config(), device, kSeed), name);
  }
  SceneSource source(make_scene(clip), kSeed);
  scheduler.run(source);
  std::vector<std::string> logs;
  for (const TrackLog* log : scheduler.logs()) {
    EXPECT_GT(log->revised().size(), 20u) << names[logs.size()] << " found next to nothing";
    logs.push_back(log->text());
  }
  return logs;
}

class SideBySide : public testing::TestWithParam<Names> {};

std::string test_name(const testing::TestParamInfo<Names>& info) {
  std::string name;
  for (const std::string& part : info.param) name += (name.empty() ? "" : "_") + part;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Trackers, SideBySide,
                         testing::Values(Names{"mm-phd", "pmht-imm"}, Names{"pmht-imm", "mm-phd"},
                                         Names{"h-pmht", "imm-jpda", "smc-phd"}),
                         test_name);

TEST_P(SideBySide, EachLogIsTheOneOfTheTrackerAlone) {
  std::vector<std::string> alone;
  for (const std::string& name : GetParam()) {
    alone.push_back(logs_of({name}, Device::tbb(1)).front());
  }
  for (const int threads : {1, 2}) {
    const auto together = logs_of(GetParam(), Device::tbb(threads));
    ASSERT_EQ(together.size(), alone.size());
    for (std::size_t i = 0; i < alone.size(); ++i) {
      EXPECT_EQ(first_other_line(alone[i], together[i]), 0u)
          << GetParam()[i] << " on " << threads << " threads, first different line";
      const auto again = logs_of({GetParam()[i]}, Device::tbb(threads)).front();
      EXPECT_EQ(first_other_line(alone[i], again), 0u)
          << GetParam()[i] << " alone on " << threads << " threads, first different line";
    }
  }
}

}  // namespace
}  // namespace glint
