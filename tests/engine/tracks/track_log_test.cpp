// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/tracks/track_log.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace glint {
namespace {

using FrameAndTrack = std::pair<std::int64_t, std::int64_t>;

TrackPoint point(std::int64_t frame, std::int64_t id, double x = 0) {
  TrackPoint p;
  p.frame = frame;
  p.track_id = id;
  p.x = x;
  return p;
}

std::vector<FrameAndTrack> keys(const std::vector<TrackPoint>& points) {
  std::vector<FrameAndTrack> out;
  out.reserve(points.size());
  for (const TrackPoint& p : points) out.emplace_back(p.frame, p.track_id);
  return out;
}

TEST(TrackLog, IsEmptyAtFirst) {
  const TrackLog log;
  EXPECT_TRUE(log.online().empty());
  EXPECT_TRUE(log.revised().empty());
  EXPECT_TRUE(log.at(0).empty());
}

TEST(TrackLog, OrdersByFrameThenTrackWhateverTheCalls) {
  std::vector<TrackPoint> points;
  for (std::int64_t frame : {0L, 1L, 5L, 1000000000000L}) {
    for (std::int64_t id : {2, 3, 7}) points.push_back(point(frame, id, double(frame + id)));
  }
  TrackLog sorted;
  for (const TrackPoint& p : points) sorted.report(p);
  const std::string expected = sorted.text();
  EXPECT_EQ(keys(sorted.online()), keys(points));
  for (int rotation = 1; rotation < 12; ++rotation) {
    std::rotate(points.begin(), points.begin() + 5, points.end());
    TrackLog forward, backward;
    for (const TrackPoint& p : points) forward.report(p);
    std::for_each(points.rbegin(), points.rend(), [&](const auto& p) { backward.report(p); });
    EXPECT_EQ(forward.text(), expected);
    EXPECT_EQ(backward.text(), expected);
  }
}

TEST(TrackLog, LastReportOfAFrameAndTrackStands) {
  TrackLog log;
  log.report(point(3, 1, 10));
  log.report(point(3, 1, 20));
  ASSERT_EQ(log.online().size(), 1u);
  EXPECT_EQ(log.online()[0].x, 20);
}

TEST(TrackLog, RevisionsLeaveTheOnlineRecordAlone) {
  TrackLog log;
  log.report(point(0, 1, 10));
  log.report(point(1, 1, 11));
  log.revise(point(0, 1, 9));
  log.revise(point(-1, 1, 8));
  EXPECT_EQ(keys(log.online()), (std::vector<FrameAndTrack>{{0, 1}, {1, 1}}));
  EXPECT_EQ(log.online()[0].x, 10);
  EXPECT_EQ(keys(log.revised()), (std::vector<FrameAndTrack>{{-1, 1}, {0, 1}, {1, 1}}));
  EXPECT_EQ(log.revised()[1].x, 9);
}

TEST(TrackLog, ConfirmsTentativePointsFromAFrameOn) {
  TrackLog log;
  for (std::int64_t frame = 0; frame < 4; ++frame) {
    TrackPoint p = point(frame, 1);
    if (frame == 3) p.status = TrackStatus::halted;
    log.report(p);
    log.report(point(frame, 2));
  }
  log.confirm(1, 1);
  std::vector<TrackStatus> of_track_1;
  for (const TrackPoint& p : log.revised()) {
    if (p.track_id == 1) {
      of_track_1.push_back(p.status);
    } else {
      EXPECT_EQ(p.status, TrackStatus::tentative);
    }
  }
  using enum TrackStatus;
  EXPECT_EQ(of_track_1, (std::vector{tentative, confirmed, confirmed, halted}));
  for (const TrackPoint& p : log.online()) EXPECT_NE(p.status, confirmed);
}

TEST(TrackLog, DropsPointsFromAFrameOn) {
  TrackLog log;
  for (std::int64_t frame = 0; frame < 3; ++frame) {
    for (std::int64_t id : {1, 2, 3}) log.report(point(frame, id));
  }
  log.drop(3, 1);
  log.drop(1, 2);
  log.drop(9, 0);
  EXPECT_EQ(keys(log.revised()),
            (std::vector<FrameAndTrack>{{0, 1}, {0, 2}, {0, 3}, {1, 1}, {1, 2}, {2, 2}}));
  EXPECT_EQ(log.online().size(), 9u);
  log.report(point(1, 4));
  log.report(point(2, 1));
  EXPECT_EQ(
      keys(log.revised()),
      (std::vector<FrameAndTrack>{{0, 1}, {0, 2}, {0, 3}, {1, 1}, {1, 2}, {1, 4}, {2, 1}, {2, 2}}));
}

TEST(TrackLog, AtGivesTheOnlinePointsOfOneFrame) {
  TrackLog log;
  for (std::int64_t frame : {0, 2}) {
    for (std::int64_t id : {5, 4}) log.report(point(frame, id));
  }
  log.revise(point(2, 6));
  EXPECT_EQ(keys(log.at(2)), (std::vector<FrameAndTrack>{{2, 4}, {2, 5}}));
  EXPECT_TRUE(log.at(1).empty());
  EXPECT_TRUE(log.at(3).empty());
  std::vector<TrackPoint> points(7);
  const TrackPoint* const storage = points.data();
  log.at(0, points);
  EXPECT_EQ(keys(points), (std::vector<FrameAndTrack>{{0, 4}, {0, 5}}));
  EXPECT_EQ(points.data(), storage);
}

// Random calls against the plainest record there is: a map.
TEST(TrackLog, AgreesWithAMap) {
  TrackLog log;
  std::int64_t forgotten = 0;
  std::map<FrameAndTrack, double> online, revised;
  for (std::uint32_t call = 0; call < 3000; ++call) {
    const auto random = [&](std::uint32_t purpose, std::uint32_t below) {
      return static_cast<std::int64_t>((call * 2654435761u ^ purpose * 40503u) % 7919u % below);
    };
    const std::int64_t frame = random(1, 40), id = random(2, 9);
    if (call % 400 == 399) {
      log.forget(++forgotten);
      const auto gone = [&](const auto& entry) { return entry.first.first < forgotten; };
      std::erase_if(online, gone), std::erase_if(revised, gone);
    }
    if (const auto kind = random(3, 10); kind < 6) {
      log.report(point(frame, id, call));
      if (frame >= forgotten) online[{frame, id}] = revised[{frame, id}] = call;
    } else if (kind < 9) {
      log.revise(point(frame, id, call));
      if (frame >= forgotten) revised[{frame, id}] = call;
    } else {
      log.drop(id, frame);
      std::erase_if(revised, [&](const auto& entry) {
        return entry.first.first >= frame && entry.first.second == id;
      });
    }
  }
  const auto as_map = [](const std::vector<TrackPoint>& points) {
    std::map<FrameAndTrack, double> out;
    for (const TrackPoint& p : points) out[{p.frame, p.track_id}] = p.x;
    return out;
  };
  EXPECT_EQ(as_map(log.online()), online);
  EXPECT_EQ(as_map(log.revised()), revised);
  EXPECT_EQ(log.online().size(), online.size());
  EXPECT_TRUE(std::ranges::is_sorted(keys(log.revised())));
}

TEST(TrackLog, ConfirmsNoPointThatDoubtsItself) {
  TrackLog log;
  for (int frame = 0; frame < 3; ++frame) {
    TrackPoint p = point(frame, 1);
    if (frame > 0) p.existence = 0.25 * frame;  // the first states none
    log.report(p);
  }
  log.confirm(1, 0, 0.5);
  const auto points = log.revised();
  EXPECT_EQ(points[0].status, TrackStatus::confirmed);
  EXPECT_EQ(points[1].status, TrackStatus::tentative);
  EXPECT_EQ(points[2].status, TrackStatus::confirmed);
}

TEST(TrackLog, TextTellsEveryDifference) {
  TrackLog log;
  log.set_mode_names({"cv", "turn"});
  TrackPoint p = point(4, 2, 0.1);
  p.mode_probability = {0.25, 0.75};
  log.report(p);
  EXPECT_EQ(log.text(),
            "modes cv turn\nonline\n"
            "4 2 tentative 0 0.1 nan nan nan nan nan nan nan nan nan nan nan nan nan nan nan "
            "0.25 0.75\nrevised\n"
            "4 2 tentative 0 0.1 nan nan nan nan nan nan nan nan nan nan nan nan nan nan nan "
            "0.25 0.75\n");
  const std::string before = log.text();
  p.x = std::nextafter(p.x, 1.0);
  log.revise(p);
  const std::string moved = log.text();
  EXPECT_NE(moved, before);
  p.cov_vx_vy = 1;
  log.revise(p);
  EXPECT_NE(log.text(), moved);
}

TEST(TrackLog, TextDoesNotTellNaNsApart) {
  TrackLog plus, minus;
  plus.report(point(0, 0, TrackPoint::kUnknown));
  minus.report(point(0, 0, -TrackPoint::kUnknown));
  EXPECT_EQ(plus.text(), minus.text());
}

TEST(TrackLog, HoldsEightMotionModels) {
  TrackLog log;
  log.set_mode_names(std::vector<std::string>(8, "cv"));
  EXPECT_THROW(log.set_mode_names(std::vector<std::string>(9, "cv")), std::invalid_argument);
  ModeProbability p;
  for (int i = 0; i < 8; ++i) p.push_back(i);
  EXPECT_EQ(p.size(), 8u);
  EXPECT_EQ(p[7], 7);
  EXPECT_THROW(p.push_back(8), std::length_error);
  p.resize(2);
  p.resize(3);
  EXPECT_EQ(p[2], 0);
}

}  // namespace
}  // namespace glint
