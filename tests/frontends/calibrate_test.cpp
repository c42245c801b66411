// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli.hpp"

namespace glint::test {
namespace {

const std::string kSmall =
    "calibrate viterbi --size 40x32 --frames 12 --runs 2 --false-tracks 200 --set "
    "trackers.viterbi.psf_sigma=0.6 ";

TEST(CalibrateCommand, PrintsASettingThatCanBePasted) {
  const Folder folder;
  const Result result = glint(folder, kSmall + "--json --threads 1");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(has(result.err, "warning")) << result.err;  // of a handful of tracks
  const auto found = nlohmann::json::parse(result.out);
  EXPECT_LE(found["attained"]["rate"], 200);
  EXPECT_EQ(found["width"], 40);
  EXPECT_EQ(found["height"], 32);
  const std::string set = found["set"];
  EXPECT_TRUE(set.starts_with("trackers.viterbi.threshold=")) << set;
  EXPECT_EQ(glint(folder, "track scene:noise --tracker viterbi --set " + set).code, 0);
  EXPECT_EQ(glint(folder, kSmall + "--json --threads 2").out, result.out);
}

TEST(CalibrateCommand, TakesTheTrackersOtherSettings) {
  const Folder folder;
  const Result slow = glint(folder, kSmall + "--quiet --set speed_max=1");
  EXPECT_EQ(slow.code, 0);
  EXPECT_EQ(slow.err, "");
  EXPECT_TRUE(has(slow.out, "false tracks per frame and megapixel"));
  EXPECT_NE(slow.out, glint(folder, kSmall + "--quiet").out);
}

TEST(CalibrateCommand, WrongUseIsExitCodeTwoAndOneLine) {
  const Folder folder;
  expect_error(glint(folder, "calibrate"), 2, "TRACKER");
  expect_error(glint(folder, "calibrate no-such"), 2, "viterbi");
  for (const char* size : {"40", "40x", "x40", "0x4", "4x4x4", "40x99999", "axb"}) {
    expect_error(glint(folder, std::string("calibrate viterbi --size ") + size), 2, "--size");
  }
  expect_error(glint(folder, "calibrate viterbi --runs 0"), 2, "--runs");
  expect_error(glint(folder, "calibrate viterbi --false-tracks -1"), 2, "--false-tracks");
}

}  // namespace
}  // namespace glint::test
