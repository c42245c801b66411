// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/points_source.hpp"
#include "glint/engine/trackers/registry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli.hpp"
#include "glint/frontends/files/tables.hpp"

namespace glint {
namespace {

using test::Folder;
using test::has;
using test::message_of;

std::vector<SourceFrame> all_of(Source& source) {
  std::vector<SourceFrame> frames;
  while (auto frame = source.next()) frames.push_back(std::move(*frame));
  return frames;
}

std::vector<SourceFrame> read(const Folder& folder, const std::string& name,
                              const std::string& content) {
  return all_of(*open_points(folder.write(name, content)));
}

TEST(PointsSource, RowsOfAFrameAreAScanAndGapsAreEmptyScans) {
  const Folder folder;
  const auto source = open_points(folder.write(
      "p.csv", "# by hand\nframe,time,x,y,amplitude\n1,10,2,3,7\n1,10,4,5,8\n4,16,6,7,9\n"));
  EXPECT_EQ(source->frame_count(), 5);
  EXPECT_DOUBLE_EQ(source->frame_rate(), 0.5);
  const auto frames = all_of(*source);
  ASSERT_EQ(frames.size(), 5U);
  EXPECT_TRUE(frames[0].points->empty());
  EXPECT_EQ(*frames[1].points, (std::vector<PointMeasurement>{{2, 3, 7}, {4, 5, 8}}));
  EXPECT_TRUE(frames[2].points->empty());
  EXPECT_DOUBLE_EQ(frames[0].time, 8);
  EXPECT_DOUBLE_EQ(frames[2].time, 12);
  EXPECT_DOUBLE_EQ(frames[3].time, 14);
  EXPECT_EQ(*frames[4].points, (std::vector<PointMeasurement>{{6, 7, 9}}));
}

TEST(PointsSource, TimesAloneMakeScansToo) {
  const Folder folder;
  const auto frames = read(folder, "p.csv", "time,x,y\n.5,1,2\n.5,3,4\n.75,,\n2,5,6\n");
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0].points->size(), 2U);
  EXPECT_TRUE(frames[1].points->empty());
  EXPECT_DOUBLE_EQ(frames[2].time, 2);
  EXPECT_EQ(frames[2].points->at(0).y, 6);
  EXPECT_TRUE(std::isnan(frames[2].points->at(0).amplitude));
}

TEST(PointsSource, JsonLinesHoldTheSame) {
  const Folder folder;
  const auto frames = read(folder, "p.jsonl",
                           "{\"frame\": 0, \"x\": 1, \"y\": 2, \"amplitude\": 3}\n\n"
                           "{\"frame\": 1, \"kind\": \"radar\", \"x\": null, \"y\": null}\n");
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(*frames[0].points, (std::vector<PointMeasurement>{{1, 2, 3}}));
  EXPECT_TRUE(frames[1].points->empty());
}

TEST(PointsSource, RangeAndAnglesBecomePositions) {
  const Folder folder;
  const std::string pi = std::to_string(std::numbers::pi);
  const auto frames =
      read(folder, "p.csv", "time,range,azimuth,elevation\n0,10," + pi + ",\n0,10,0,1.0471976\n");
  const auto& points = frames.at(0).points.value();
  EXPECT_NEAR(points[0].x, -10, 1e-4);
  EXPECT_NEAR(points[0].y, 0, 1e-4);
  EXPECT_NEAR(points[1].x, 5, 1e-4);
}

TEST(PointsSource, CoordinatesAndTimesKeepAllTheirDigits) {
  const Folder folder;
  const auto frames =
      read(folder, "p.csv", "time,x,y\n2000000000.000001,1397634160.123,-356785133.456\n");
  EXPECT_EQ(frames.at(0).time, 2000000000.000001);
  EXPECT_EQ(frames.at(0).points->at(0).x, 1397634160.123);
  EXPECT_EQ(frames.at(0).points->at(0).y, -356785133.456);
  const auto lines = read(folder, "p.jsonl", "{\"frame\": 0, \"x\": 500000.02, \"y\": 5e6}\n");
  EXPECT_EQ(lines.at(0).points->at(0).x, 500000.02);
  const auto polar =
      read(folder, "p.csv", "time,range,azimuth,sensor_x,sensor_y\n0,3,0,500000.25,5000000.5\n");
  EXPECT_EQ(polar.at(0).points->at(0).x, 500003.25);
}

TEST(PointsSource, MistakesAreNamedWithFileAndLine) {
  const Folder folder;
  const auto refused = [&](const std::string& name, const std::string& content) {
    const auto path = folder.write(name, content);
    return message_of<std::runtime_error>([&] { open_points(path); });
  };
  EXPECT_TRUE(has(refused("p.csv", "x,y\n1,2\n"), "p.csv:2: has neither frame nor time"));
  EXPECT_TRUE(has(refused("p.csv", "frame,x,y\n1,2,3\n0,2,3\n"), "p.csv:3: frame 0 comes after"));
  EXPECT_TRUE(has(refused("p.csv", "time,x,y\n1,2,3\n0.5,2,3\n"), "p.csv:3: time 0.5 comes after"));
  EXPECT_TRUE(has(refused("p.csv", "frame,x,y\n0,2,\n"), "p.csv:2: holds half a position"));
  EXPECT_TRUE(has(refused("p.csv", "frame,x,y\n0.5,2,2\n"), "p.csv:2: frame must be a whole"));
  EXPECT_TRUE(has(refused("p.csv", "frame,x,y\n0,2,two\n"), "p.csv:2: y must be a number"));
  EXPECT_TRUE(has(refused("p.csv", "frame,x,y\n0,2,2\n90000000,2,2\n"), "p.csv:3: frame 90000000"));
  EXPECT_TRUE(has(refused("p.jsonl", "{\"frame\": 0}\nno\n"), "p.jsonl:2: must be one JSON"));
}

/// A target along a line and two points of clutter a scan.
std::string target(const Folder& folder) {
  std::string rows = "time,x,y,amplitude\n";
  for (int t = 0; t < 12; ++t) {
    const std::string time = std::to_string(0.5 * t) + ',';
    rows += time + std::to_string(10 + 2 * t) + ',' + std::to_string(20 + t) + ",9\n";
    rows += time + std::to_string(31 * t % 97) + ",90,2\n" + time + "95," +
            std::to_string(53 * t % 89) + ",2\n";
  }
  return folder.write("points.csv", rows);
}

TEST(PointsSource, TrackersOfPointsNeedNoFrames) {
  const Folder folder;
  const std::string tracks = folder / "tracks.csv";
  const auto result = test::glint(folder, "track " + target(folder) +
                                              " --tracker imm-pda-ai --set "
                                              "trackers.imm-pda-ai.start_amplitude=5 --out " +
                                              tracks);
  ASSERT_EQ(result.code, 0) << result.err;
  const std::vector<TrackPoint> points = read_tracks(tracks);
  ASSERT_FALSE(points.empty());
  EXPECT_EQ(points.back().frame, 11);
  EXPECT_DOUBLE_EQ(points.back().time, 5.5);
  EXPECT_EQ(points.back().status, TrackStatus::confirmed);
  EXPECT_NEAR(points.back().x, 32, 1);
  EXPECT_NEAR(points.back().y, 31, 1);
  EXPECT_NEAR(points.back().vx, 4, 0.5);
}

TEST(PointsSource, PointsWithoutAmplitudeStartTracksOfEveryTracker) {
  const Folder folder;
  std::string rows = "frame,x,y\n";
  for (int t = 0; t < 20; ++t) {
    rows +=
        std::to_string(t) + ',' + std::to_string(10 + 2 * t) + ',' + std::to_string(20 + t) + '\n';
    for (const int k : {31, 47, 71}) {
      rows += std::to_string(t) + ',' + std::to_string(k * (t + 3) % 297) + ',' +
              std::to_string(k * (t + 5) % 189) + '\n';
    }
  }
  const std::string input = folder.write("points.csv", rows), tracks = folder / "tracks.csv";
  for (const TrackerEntry& tracker : all_trackers()) {
    if (tracker.feed == Feed::frames) continue;
    const std::string name(tracker.name);
    const auto result =
        test::glint(folder, "track " + input + " --tracker " + name + " --out " + tracks);
    ASSERT_EQ(result.code, 0) << name << result.err;
    const std::vector<TrackPoint> points = read_tracks(tracks);
    EXPECT_TRUE(std::ranges::any_of(points, [](const TrackPoint& p) {
      return p.frame == 19 && p.status == TrackStatus::confirmed && std::abs(p.x - 48) < 2 &&
             std::abs(p.y - 39) < 2;
    })) << name;
  }
}

TEST(PointsSource, WhatNeedsFramesIsRefused) {
  const Folder folder;
  const std::string track = "track " + target(folder);
  test::expect_error(test::glint(folder, track + " --tracker smc-phd"), 2, "needs frames");
  test::expect_error(test::glint(folder, track + " --tracker imm-pda-ai --add-noise 1"), 2,
                     "leave --add-noise out");
  test::expect_error(
      test::glint(folder, track + " --tracker imm-pda-ai --picture " + (folder / "p.png")), 2,
      "leave --overlay and --picture out");
}

}  // namespace
}  // namespace glint
