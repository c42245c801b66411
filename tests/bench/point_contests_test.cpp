// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/point_contests.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

#include "glint/engine/trackers/registry.hpp"

namespace glint::bench {

// For what gtest says of a case.
inline void PrintTo(const PointContest& contest, std::ostream* out) { *out << contest.tracker; }

namespace {

struct PointContests : testing::TestWithParam<PointContest> {};

// Median position of every target after the last scan over seeds 1, 2, ...: [x y] by target, for a
// run may lose a target.
std::vector<double> median_positions(const PointContest::Follow& follow, const PointScans& scans,
                                     int runs) {
  std::vector<std::vector<double>> all(2 * scans.starts.size());
  for (int run = 1; run <= runs; ++run) {
    const PointStates states = follow(scans, static_cast<std::uint64_t>(run));
    EXPECT_EQ(2 * states.size(), all.size());
    for (std::size_t t = 0; t < states.size(); ++t) {
      all[2 * t].push_back(states[t](0)), all[2 * t + 1].push_back(states[t](2));
    }
  }
  std::vector<double> medians;
  for (std::vector<double>& values : all) {
    std::ranges::sort(values);
    medians.push_back(values[values.size() / 2]);
  }
  return medians;
}

std::string test_name(const testing::TestParamInfo<PointContest>& info) {
  std::string name = info.param.tracker;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Trackers, PointContests, testing::ValuesIn(point_contests()), test_name);

// A ratio of times means something only if both end with the same.
TEST_P(PointContests, BaselineEstimatesWhatTheTrackerEstimates) {
  const PointScans scans = forty_targets(10, 20);
  const auto ours = median_positions(GetParam().ours, scans, GetParam().runs);
  const auto plain = median_positions(GetParam().plain, scans, GetParam().runs);
  double squares = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) squares += std::pow(ours[i] - plain[i], 2);
  EXPECT_LE(std::sqrt(squares / static_cast<double>(ours.size())), GetParam().tolerance);
}

TEST(PointContests, EveryTrackerOfPointsHasOne) {
  const auto contests = point_contests();
  for (const TrackerEntry& entry : all_trackers()) {
    const auto found = std::ranges::find(contests, entry.name, &PointContest::tracker);
    EXPECT_EQ(found != contests.end(), entry.feed != Feed::frames) << entry.name;
  }
}

}  // namespace
}  // namespace glint::bench
