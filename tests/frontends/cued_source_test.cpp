// SPDX-License-Identifier: Apache-2.0
// A file of targets that tracks start on.
#include "glint/frontends/files/cued_source.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cli.hpp"

namespace glint {
namespace {

using test::Folder;
using test::has;
using test::message_of;

// Frames of 20x10 pixels, two a second, from time 10 on.
struct SmallFilm : Source {
  std::optional<SourceFrame> next() override {
    if (at == 4) return std::nullopt;
    SourceFrame frame;
    frame.pixels = {pixels.data(), 20, 10, 1, 20};
    frame.time = 10 + 0.5 * at++;
    return frame;
  }
  double frame_rate() const override { return 2; }
  std::vector<float> pixels = std::vector<float>(200);
  int at = 0;
};

struct CuedRead {
  std::vector<std::vector<Cue>> cues;  // by frame
  std::vector<std::string> warnings;
};

CuedRead cued(const Folder& folder, const std::string& content) {
  CuedRead read;
  const auto source = with_cues(std::make_unique<SmallFilm>(), folder.write("c.csv", content),
                                [&](const std::string& w) { read.warnings.push_back(w); });
  while (const auto frame = source->next()) read.cues.push_back(frame->cues);
  return read;
}

TEST(CuedSource, CuesGoToTheFrameOfTheirNumber) {
  const Folder folder;
  const CuedRead read = cued(folder, "frame,x,y,vx,vy,sigma\n2,3,4,5,6,0.5\n0,1,2,,,\n2,7,8,,,\n");
  ASSERT_EQ(read.cues.size(), 4U);
  ASSERT_EQ(read.cues[0].size(), 1U);
  EXPECT_FALSE(read.cues[0][0].moves());
  EXPECT_TRUE(std::isnan(read.cues[0][0].sigma));
  EXPECT_TRUE(read.cues[1].empty());
  ASSERT_EQ(read.cues[2].size(), 2U);
  EXPECT_EQ(read.cues[2][0].vy, 6);
  EXPECT_EQ(read.cues[2][0].sigma, 0.5);
  EXPECT_EQ(read.cues[2][1].x, 7);
  EXPECT_TRUE(read.warnings.empty());
}

// 10.7 s is nearest to frame 1, at 10.5 s; nearer than half an interval counts.
TEST(CuedSource, CuesOfATimeGoToTheFrameThereMovedOn) {
  const Folder folder;
  const CuedRead read = cued(folder, "time,x,y,vx,vy\n10.7,5,5,10,-5\n10.8,5,5,,\n");
  ASSERT_EQ(read.cues[1].size(), 1U);
  EXPECT_NEAR(read.cues[1][0].x, 3, 1e-9);
  EXPECT_NEAR(read.cues[1][0].y, 6, 1e-9);
  EXPECT_EQ(read.cues[2].size(), 1U);
}

TEST(CuedSource, OfTracksTheFirstRowOfEachCounts) {
  const Folder folder;
  const CuedRead read = cued(folder,
                             "# a comment\nframe,time,track_id,status,x,y,vx,vy\n"
                             "1,10.5,1,confirmed,5,5,1,1\n2,11,1,confirmed,6,6,1,1\n"
                             "2,11,2,tentative,8,8,,\n");
  EXPECT_EQ(read.cues[1].size(), 1U);
  ASSERT_EQ(read.cues[2].size(), 1U);
  EXPECT_EQ(read.cues[2][0].x, 8);
}

TEST(CuedSource, CuesThatStartNothingAreSaid) {
  const Folder folder;
  const CuedRead read = cued(folder, "frame,x,y\n1,20,5\n1,19.4,9.4\n4,5,5\n9,5,5\n");
  ASSERT_EQ(read.warnings.size(), 2U);
  EXPECT_TRUE(has(read.warnings[0], "c.csv:2: the cue at (20, 5) lies outside the frame of 20x10"));
  EXPECT_TRUE(has(read.warnings[1], "c.csv: 2 cues belong to no frame (there were 4)"));
}

TEST(CuedSource, WhatIsNoCueIsNamedWithItsLine) {
  const Folder folder;
  const auto error = [&](const std::string& content) {
    return message_of<std::runtime_error>([&] { cued(folder, content); });
  };
  EXPECT_TRUE(has(error("x,y\n1,2\n"), "c.csv:2: a cue needs its frame, or its time"));
  EXPECT_TRUE(has(error("frame,x,y\n0,1,2\n-1,1,2\n"), "c.csv:3: frame must be at least 0"));
  EXPECT_TRUE(has(error("frame,x,y\n0,1,\n"), "c.csv:2: a cue's x and y must be numbers"));
  EXPECT_TRUE(has(error("frame,x,y,vx\n0,1,2,3\n"), "c.csv:2: a cue's vx and vy must both"));
  EXPECT_TRUE(has(error("frame,x,y,sigma\n0,1,2,0\n"), "c.csv:2: a cue's sigma must be above 0"));
  EXPECT_TRUE(has(error("frame,x\n0,1\n"), "y"));
  EXPECT_TRUE(has(message_of<UsageError>(
                      [&] { with_cues(std::make_unique<SmallFilm>(), folder / "none.csv", {}); }),
                  "none.csv"));
}

}  // namespace
}  // namespace glint
