// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/tracks/point_track.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace glint {
namespace {

constexpr HitLogic kLogic{.confirm_hits = 3, .confirm_window = 4, .halt_misses = 2};

/// A track at (3, 5) and velocity (1, -2), first seen in frame 0.
PointTrack first_seen() {
  PointTrack track{7, 0, 0, TrackLife(kLogic, false), 8};
  track.state.mean << 3, 1, 5, -2;
  track.state.covariance.diagonal() << 4, 1, 9, 1;
  track.state.covariance(0, 2) = track.state.covariance(2, 0) = 0.5;
  return track;
}

/// The next scan, of the frame after the last.
struct Life {
  PointTrack track = first_seen();
  TrackLog log;
  std::int64_t frame = 0;

  Life() { report(track, {}, {0}, 1, log); }
  void scan(bool hit) {
    track.life.see(kLogic, hit), ++frame;
    if (hit) track.last_seen = frame;
    report(track, {0.25, 0.75}, {frame, 0.1 * static_cast<double>(frame)}, 10, log);
  }
};

TEST(PointTrack, ReportsWhatIsKnownOfIt) {
  Life life;
  life.scan(true);
  const TrackPoint point = life.log.at(1).at(0);
  EXPECT_EQ(point.track_id, 7);
  EXPECT_DOUBLE_EQ(point.time, 0.1);
  EXPECT_EQ(point.status, TrackStatus::tentative);
  EXPECT_EQ(point.x, 3);
  EXPECT_EQ(point.y, 5);
  EXPECT_EQ(point.vx, 10);
  EXPECT_EQ(point.vy, -20);
  EXPECT_EQ(point.intensity, 8);
  EXPECT_TRUE(std::isnan(point.existence));
  EXPECT_EQ(point.var_x, 4);
  EXPECT_EQ(point.cov_xy, 0.5);
  EXPECT_EQ(point.var_y, 9);
  EXPECT_EQ(point.mode_probability[1], 0.75);
}

TEST(PointTrack, IsConfirmedFromItsFirstPointOn) {
  Life life;
  life.scan(true), life.scan(true);
  for (const TrackPoint& point : life.log.revised()) {
    EXPECT_EQ(point.status, TrackStatus::confirmed) << point.frame;
  }
  EXPECT_EQ(life.log.at(1).at(0).status, TrackStatus::tentative);  // as reported at the time
}

TEST(PointTrack, EndsWhereItWasSeenLast) {
  Life life;
  life.scan(true), life.scan(true), life.scan(false), life.scan(false);
  EXPECT_EQ(life.log.at(4).at(0).status, TrackStatus::halted);
  ASSERT_EQ(life.log.revised().size(), 3u);
  EXPECT_EQ(life.log.revised().back().frame, 2);
}

TEST(PointTrack, NeverWasIfItEndsTentative) {
  Life life;
  life.scan(true), life.scan(false), life.scan(false);
  EXPECT_TRUE(life.log.at(3).empty());
  EXPECT_TRUE(life.log.revised().empty());
  EXPECT_EQ(life.log.online().size(), 3u);
}

TEST(PointTrack, IsNearWhileItLives) {
  PointTrack track = first_seen();
  EXPECT_TRUE(track.near({6, 9}, 5.01));
  EXPECT_FALSE(track.near({6, 9}, 5));
  track.life.end();
  EXPECT_FALSE(track.near({3, 5}, 5));
}

}  // namespace
}  // namespace glint
