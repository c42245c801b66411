// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/identities.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "engine/trackers/phd/few_particles.hpp"

namespace glint {
namespace {

using namespace test;

/// A peak at (x, 20) with the weight that its particles have under each label.
struct TestPeak {
  double x = 0, vx = 0;
  std::vector<std::pair<std::uint32_t, float>> labels{{0, 1.0F}};
};

class Tracks {
 public:
  explicit Tracks(const IdentityConfig& config = {}) : identities_(config, 1) {}
  /// The next frame, or `step` frames on; returns the labels of the peaks' first particles.
  /// Of peaks in order of falling mass those from `targets` on are faint.
  std::vector<std::uint32_t> see(const std::vector<TestPeak>& list, int step = 1,
                                 double velocity_scale = 1, std::size_t targets = 1000) {
    std::vector<TestParticle> particles;
    std::vector<Peak> peaks;
    for (const TestPeak& t : list) {
      Peak peak;
      peak.x = t.x, peak.vx = t.vx, peak.y = 20, peak.mass = 0;
      peak.first = particles.size();
      for (const auto& [label, weight] : t.labels) {
        particles.push_back({.weight = weight, .label = label});
        peak.mass += weight;
      }
      peak.last = particles.size();
      peaks.push_back(peak);
    }
    Particles p = particles_of(particles);
    frame_ += step;
    targets = std::min(targets, peaks.size());
    identities_.assign(
        std::span(peaks).first(targets), std::span(peaks).subspan(targets), all_members(p), p,
        {frame_, static_cast<double>(frame_), static_cast<double>(step), velocity_scale}, 1, log);
    std::vector<std::uint32_t> labels;
    for (const Peak& peak : peaks) {
      for (std::size_t i = peak.first; i < peak.last; ++i) {
        if (p.label[i] != p.label[peak.first]) ADD_FAILURE() << "one peak, two labels";
      }
      labels.push_back(p.label[peak.first]);
    }
    return labels;
  }
  const Identities& identities() const { return identities_; }
  TrackLog log;

 private:
  Identities identities_;
  std::int64_t frame_ = -1;
};

using Labels = std::vector<std::uint32_t>;

TEST(Identities, ATrackCoastsAtItsVelocityOverAGapOfFrames) {
  Tracks tracks;
  EXPECT_EQ(tracks.see({{10, 4}}), Labels{1});
  EXPECT_EQ(tracks.see({{22, 4}}, 3), Labels{1});
}

TEST(Identities, APeakFarFromWhereALostTrackShouldBeIsAnotherTarget) {
  Tracks tracks;
  EXPECT_EQ(tracks.see({{10, 4}}), Labels{1});
  EXPECT_EQ(tracks.see({{22, 4}}), Labels{2});
}

TEST(Identities, APeakTakesTheLabelOfMostOfItsWeight) {
  Tracks tracks;
  EXPECT_EQ(tracks.see({{10}, {30}}), (Labels{1, 2}));
  // Three light particles of one track, one heavy particle of the other.
  EXPECT_EQ(tracks.see({{18, 0, {{1, 0.1F}, {1, 0.1F}, {2, 0.5F}, {1, 0.1F}}}}), Labels{2});
}

TEST(Identities, OfTwoPeaksOfOneLabelTheHeavierHasIt) {
  Tracks tracks;
  EXPECT_EQ(tracks.see({{10}}), Labels{1});
  EXPECT_EQ(tracks.see({{12, 0, {{1, 0.9F}}}, {30, 0, {{1, 0.6F}}}}), (Labels{1, 2}));
}

TEST(Identities, ATenthOfTheWeightIsNoLabel) {
  Tracks tracks;
  EXPECT_EQ(tracks.see({{10}}), Labels{1});
  EXPECT_EQ(tracks.see({{30, 0, {{0, 0.91F}, {1, 0.09F}}}}), Labels{2});
  EXPECT_EQ(tracks.see({{30, 0, {{0, 0.87F}, {1, 0.13F}}}}), Labels{1});
}

TEST(Identities, APeakWithoutALabelTakesTheNearestLostTrack) {
  IdentityConfig config;
  config.separation = 0;
  Tracks tracks(config);
  EXPECT_EQ(tracks.see({{10}, {13}}), (Labels{1, 2}));
  EXPECT_EQ(tracks.see({{12.5}}), Labels{2});
}

TEST(Identities, ANewTrackKeepsItsDistance) {
  Tracks tracks;
  EXPECT_EQ(tracks.see({{10}, {15.9}, {16.1}}), (Labels{1, 0, 2}));
  EXPECT_EQ(tracks.log.at(0).size(), 2U);
}

TEST(Identities, ATrackIsConfirmedByItsFourthPeakAndItsEarlierPointsWithIt) {
  Tracks tracks;
  for (int k = 0; k < 3; ++k) tracks.see({{10}});
  EXPECT_EQ(tracks.log.revised().front().status, TrackStatus::tentative);
  tracks.see({{10}});
  EXPECT_EQ(tracks.log.at(2)[0].status, TrackStatus::tentative);
  EXPECT_EQ(tracks.log.at(3)[0].status, TrackStatus::confirmed);
  EXPECT_EQ(tracks.log.revised().front().status, TrackStatus::confirmed);
}

TEST(Identities, ATrackEndsAfterThreeFramesInARowWithoutAPeak) {
  Tracks tracks;
  for (int k = 0; k < 4; ++k) tracks.see({{10.0 + 2 * k, 2}});
  tracks.see({}), tracks.see({});
  EXPECT_EQ(tracks.see({{22, 2}}), Labels{1});  // counted anew from here
  tracks.see({}), tracks.see({});
  EXPECT_TRUE(tracks.log.at(8).empty());
  tracks.see({}, 1, 10);
  ASSERT_EQ(tracks.log.at(9).size(), 1U);
  const TrackPoint end = tracks.log.at(9)[0];
  EXPECT_EQ(end.status, TrackStatus::halted);
  EXPECT_NEAR(end.x, 28, 1e-9);  // where it was predicted
  EXPECT_NEAR(end.vx, 20, 1e-9);
  EXPECT_EQ(tracks.see({{30, 2}}), Labels{2});
}

TEST(Identities, ATentativeTrackEndsInSilence) {
  Tracks tracks;
  tracks.see({{10}});
  for (int k = 0; k < 3; ++k) tracks.see({});
  EXPECT_EQ(tracks.log.online().size(), 1U);
}

TEST(Identities, ReportVelocityInPixelsPerSecondAndExistenceOfAtMostOne) {
  Tracks tracks;
  tracks.see({{10, 3, {{0, 0.7F}}}, {30, 0, {{0, 1.4F}}}}, 1, 25);
  const auto points = tracks.log.at(0);
  EXPECT_NEAR(points[0].vx, 75, 1e-9);
  EXPECT_NEAR(points[0].existence, 0.7, 1e-6);
  EXPECT_EQ(points[1].existence, 1);
}

// A PHD's mass knows one frame only: what it says of the frame's likelihood ratio counts.
TEST(Identities, ExistenceRemembersAllFramesWithAPeak) {
  Tracks tracks;
  const TestPeak first{10, 0, {{0, 0.5F}}}, later{10, 0, {{1, 0.75F}}};
  tracks.see({first});
  tracks.see({later});  // odds 3 from 1/2: a ratio of 6
  EXPECT_NEAR(tracks.log.at(1)[0].existence, 6.0 / 7, 1e-6);
  tracks.see({later});  // odds 3 from 3/4: a ratio of 4
  EXPECT_NEAR(tracks.log.at(2)[0].existence, 24.0 / 25, 1e-6);
  tracks.see({});
  tracks.see({later});  // what went before the miss is not known any more
  EXPECT_NEAR(tracks.log.at(4)[0].existence, 0.75, 1e-6);
}

// What is left of a track where it has no peak: a miss, in which it is tentative.
TEST(Identities, AFaintPeakSaysHowLikelyAMissedTrackIsStill) {
  Tracks tracks({.confirm_hits = 1});
  tracks.see({{10, 0, {{0, 0.75F}}}});
  const TestPeak left{10, 0, {{1, 0.2F}}}, other{40, 0, {{0, 0.3F}}};
  tracks.see({left, other}, 1, 1, 0);  // odds 1/4 from 3/4: a ratio of 1/3 on odds of 3
  ASSERT_EQ(tracks.log.at(1).size(), 1U);
  EXPECT_NEAR(tracks.log.at(1)[0].existence, 0.5, 1e-6);
  EXPECT_EQ(tracks.log.at(1)[0].status, TrackStatus::tentative);
  tracks.see({});
  tracks.see({});
  const auto end = tracks.log.at(3);  // the third miss
  ASSERT_EQ(end.size(), 1U);
  EXPECT_EQ(end[0].status, TrackStatus::halted);
  EXPECT_EQ(end[0].existence, 0);
}

TEST(Identities, TellWhichTracksAFrameConfirmedAndWhereTheyBegan) {
  Tracks tracks({.confirm_hits = 3});
  tracks.see({{10}});
  EXPECT_TRUE(tracks.identities().confirmed_now().empty());
  const TestPeak first{10, 0, {{1, 1.0F}}}, second{40, 0, {{2, 1.0F}}};
  tracks.see({first, {40}});
  tracks.see({second, first});  // the first track, seen in frames 0, 1 and 2, is peak 1
  ASSERT_EQ(tracks.identities().confirmed_now().size(), 1U);
  const Identities::Confirmed confirmed = tracks.identities().confirmed_now()[0];
  EXPECT_EQ(confirmed.id, 1U);
  EXPECT_EQ(confirmed.detected, 0);
  EXPECT_EQ(confirmed.peak, 1U);
  tracks.see({first});
  EXPECT_TRUE(tracks.identities().confirmed_now().empty());
  std::vector<std::uint32_t> seen;
  tracks.identities().each_seen([&](std::uint32_t id, double x, double) {
    seen.push_back(id);
    EXPECT_EQ(x, 10);
  });
  EXPECT_EQ(seen, std::vector<std::uint32_t>{1});  // the second track is missed
}

}  // namespace
}  // namespace glint
