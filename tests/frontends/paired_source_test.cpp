// SPDX-License-Identifier: Apache-2.0
// Frames and the points of another sensor in one input.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli.hpp"
#include "glint/frontends/files/points_source.hpp"
#include "glint/frontends/files/tables.hpp"

namespace glint {
namespace {

using test::Folder;
using test::message_of;

// Frames of four pixels, two a second, from time 10 on.
struct FewFrames : Source {
  explicit FewFrames(int n) : count(n) {}
  std::optional<SourceFrame> next() override {
    if (at == count) return std::nullopt;
    SourceFrame frame;
    frame.pixels = {pixels.data(), 2, 2, 1, 2};
    frame.time = 10 + 0.5 * at++;
    return frame;
  }
  double frame_rate() const override { return 2; }
  std::vector<float> pixels = std::vector<float>(4);
  int count, at = 0;
};

struct Read {
  std::vector<SourceFrame> frames;
  std::vector<std::string> warnings;
};

Read pair(const Folder& folder, const std::string& content, int frames = 4) {
  Read read;
  const auto source =
      with_points(std::make_unique<FewFrames>(frames), folder.write("p.csv", content),
                  [&](const std::string& w) { read.warnings.push_back(w); });
  while (auto frame = source->next()) read.frames.push_back(std::move(*frame));
  return read;
}

TEST(PairedSource, PointsGoToTheFrameOfTheirNumber) {
  const Folder folder;
  const Read read = pair(folder, "frame,time,x,y,amplitude\n1,90,2,3,7\n1,90,4,5,8\n3,99,6,7,9\n");
  ASSERT_EQ(read.frames.size(), 4U);
  EXPECT_TRUE(read.frames[0].points->empty());
  EXPECT_EQ(*read.frames[1].points, (std::vector<PointMeasurement>{{2, 3, 7}, {4, 5, 8}}));
  EXPECT_TRUE(read.frames[2].points->empty());
  EXPECT_EQ(*read.frames[3].points, (std::vector<PointMeasurement>{{6, 7, 9}}));
  EXPECT_EQ(read.frames[1].pixels.width, 2);
  EXPECT_DOUBLE_EQ(read.frames[1].time, 10.5);
  EXPECT_TRUE(read.frames[0].looked);
  EXPECT_TRUE(read.warnings.empty());
}

TEST(PairedSource, PointsOfATimeGoToTheNearestFrame) {
  const Folder folder;
  const Read read = pair(folder, "time,x,y\n10.6,1,2\n11.25,3,4\n");
  ASSERT_EQ(read.frames.size(), 4U);
  EXPECT_TRUE(read.frames[0].points->empty());
  EXPECT_EQ(read.frames[1].points->size(), 1U);
  // Half-way: the earlier of the two.
  EXPECT_EQ(read.frames[2].points->size(), 1U);
  EXPECT_TRUE(read.frames[3].points->empty());
  EXPECT_TRUE(read.frames[1].looked);
  EXPECT_FALSE(read.frames[3].looked);
}

// One look in ten frames: its track has rows there alone, and does not die between.
TEST(PairedSource, ASlowSensorIsNoMissBetweenItsLooks) {
  const Folder folder;
  std::string rows = "time,x,y\n";
  for (int t = 0; t < 30; t += 10) {
    rows += std::to_string(t) + ',' + std::to_string(10 + t) + ",20\n";
  }
  const std::string tracks = folder / "tracks.csv";
  const auto run = test::glint(folder, "track scene:crossing --tracker imm-jpda --points " +
                                           folder.write("points.csv", rows) + " --out " + tracks);
  ASSERT_EQ(run.code, 0) << run.err;
  std::vector<std::int64_t> frames;
  for (const TrackPoint& p : read_tracks(tracks)) frames.push_back(p.frame);
  EXPECT_EQ(frames, (std::vector<std::int64_t>{10, 20}));
}

TEST(PairedSource, PointsBetweenFramesAreRefusedAndLateOnesWarnedOf) {
  const Folder folder;
  EXPECT_TRUE(test::has(
      message_of<std::runtime_error>([&] { pair(folder, "time,x,y\n10.4,1,2\n10.6,3,4\n"); }),
      "10.6 s belong to no frame"));
  EXPECT_TRUE(test::has(message_of<std::runtime_error>([&] { pair(folder, "time,x,y\n9,1,2\n"); }),
                        "give the rows frame numbers"));
  const Read late = pair(folder, "frame,x,y\n3,1,2\n4,1,2\n7,1,2\n");
  ASSERT_EQ(late.warnings.size(), 1U);
  EXPECT_TRUE(test::has(late.warnings[0], "2 scans of points come after the last frame"));
}

TEST(PointsSource, ASensorsPlaceIsAddedAndHandedOn) {
  const Folder folder;
  const auto pi = std::to_string(std::numbers::pi);
  const auto source =
      open_points(folder.write("p.csv", "frame,range,azimuth,sensor_x,sensor_y\n0,10," + pi +
                                            ",100,50\n0,2,0,,\n1,1,0,,\n"));
  const auto first = source->next(), second = source->next();
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->sensor_x, 100);
  EXPECT_EQ(first->sensor_y, 50);
  EXPECT_NEAR(first->points->at(0).x, 90, 1e-3);
  EXPECT_NEAR(first->points->at(0).y, 50, 1e-3);
  EXPECT_EQ(first->points->at(1).x, 102);
  EXPECT_EQ(second->sensor_x, 0);
}

TEST(PointsSource, TwoPlacesInAScanOrHalfAPlaceAreRefused) {
  const Folder folder;
  const auto message = [&](const std::string& rows) {
    const std::string path = folder.write("p.csv", "frame,x,y,sensor_x,sensor_y\n" + rows);
    return message_of<std::runtime_error>([&] { open_points(path); });
  };
  EXPECT_TRUE(test::has(message("0,1,2,5,6\n0,1,2,5,7\n"), "p.csv:3: puts the sensor at (5, 7)"));
  EXPECT_TRUE(test::has(message("0,1,2,5,\n"), "p.csv:2: holds half a place"));
}

// The rows of a track file, without the settings before them.
std::string rows_of(const std::string& path) {
  const std::string content = test::content_of(path);
  return content.substr(content.find("\nframe,"));
}

// A tracker of frames and one of points beside each other report what each reports alone.
TEST(PairedSource, TrackersOfFramesAndOfPointsRunSideBySide) {
  const Folder folder;
  std::string rows = "frame,x,y\n";
  for (int t = 0; t < 30; ++t) {
    rows +=
        std::to_string(t) + ',' + std::to_string(10 + 2 * t) + ',' + std::to_string(20 + t) + '\n';
  }
  const std::string points = folder.write("points.csv", rows);
  const std::string input = "track scene:crossing --points " + points + " --out ";
  const std::string both = input + (folder / "both.csv"), one = folder / "one.csv";
  ASSERT_EQ(test::glint(folder, both + " --tracker smc-phd --tracker imm-jpda").code, 0);
  for (const std::string tracker : {"smc-phd", "imm-jpda"}) {
    ASSERT_EQ(test::glint(folder, input + one + " --tracker " + tracker).code, 0);
    EXPECT_FALSE(read_tracks(one).empty()) << tracker;
    EXPECT_EQ(rows_of(one), rows_of(folder / ("both." + tracker + ".csv"))) << tracker;
  }
  const auto followed = read_tracks(folder / "both.imm-jpda.csv");
  EXPECT_TRUE(std::ranges::any_of(followed, [](const TrackPoint& p) {
    return p.frame == 20 && p.status == TrackStatus::confirmed && std::abs(p.x - 50) < 1 &&
           std::abs(p.y - 40) < 1;
  }));
}

TEST(PairedSource, PointsTwiceAreRefused) {
  const Folder folder;
  const std::string points = folder.write("points.csv", "frame,x,y\n0,1,2\n");
  test::expect_error(
      test::glint(folder, "track " + points + " --tracker imm-jpda --points " + points), 2,
      "holds points already");
  test::expect_error(test::glint(folder, "points scene:crossing --set run.points=" + points +
                                             " --out " + (folder / "out.csv")),
                     2, "leave run.points out");
}

}  // namespace
}  // namespace glint
