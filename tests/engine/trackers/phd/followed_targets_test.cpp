// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/followed_targets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/trackers/phd/few_particles.hpp"

namespace glint {
namespace {

using namespace test;

constexpr double kImageRatio = 100;  // L in a target's own image; 1 / L where it is missing

FollowedTargetsConfig config_of() {
  FollowedTargetsConfig c;
  c.target_particles = 4;
  c.existence = 0.6;  // one miss leaves less of it, a hit after that more
  c.confirm_hits = 3, c.halt_misses = 3;
  c.separation = 6;
  return c;
}

/// A tentative track outlives its first miss.
FollowedTargetsConfig long_patience() {
  FollowedTargetsConfig c = config_of();
  c.confirm_hits = 1;
  return c;
}

/// Targets on whole pixels that move by whole pixels a frame, without noise.
class Follower {
 public:
  explicit Follower(const FollowedTargetsConfig& config = config_of(), double ratio = kImageRatio)
      : ratio_(ratio), targets_(config, exact_motion(), Device::serial(), 1) {
    targets_.set_appearance(ready(exact_appearance(ratio)));
  }
  bool detect(int x, int y, int vx = 0, double mass = 1) {
    const auto intensity = static_cast<float>(intensity_of_ratio(ratio_));
    const Particles p = particles_of({{.x = static_cast<float>(x),
                                       .y = static_cast<float>(y),
                                       .vx = static_cast<float>(vx),
                                       .weight = static_cast<float>(mass),
                                       .intensity = intensity}});
    const auto members = all_members(p);
    const Peak peak = describe_cluster(p, members, p.weight);
    return targets_.detect({peak, p, members}, at_, log_);
  }
  /// The next frame, which shows targets at these pixels.
  void follow(const std::vector<Pixel>& visible) {
    ++at_.frame, at_.time += 1;
    at_.step = 1 + std::exchange(skipped_, 0);
    targets_.follow(image_of(ratio_, visible), at_, log_, std::exchange(cues_, {}));
  }
  /// In the next frame.
  void cue(double x, double y) { cues_.push_back({x, y, 0, 0, 0.01}); }
  /// Frames that are not looked at.
  void skip(int frames) { at_.frame += frames, at_.time += frames, skipped_ = frames; }
  std::span<const FollowedTarget> targets() const { return targets_.targets(); }
  const FollowedTarget& only() const { return targets_.targets().front(); }
  std::vector<std::size_t> confirmed_now() const {
    return {targets_.confirmed_now().begin(), targets_.confirmed_now().end()};
  }
  const TrackLog& log() const { return log_; }

 private:
  double ratio_;
  FollowedTargets targets_;
  TrackLog log_;
  StepTime at_;
  int skipped_ = 0;
  std::vector<Cue> cues_;
};

std::vector<std::int64_t> frames_of(const std::vector<TrackPoint>& points, std::int64_t track) {
  std::vector<std::int64_t> frames;
  for (const auto& p : points) {
    if (p.track_id == track) frames.push_back(p.frame);
  }
  return frames;
}

using Frames = std::vector<std::int64_t>;

constexpr Pixel kHere{10, 12};

TEST(FollowedTargets, ExistenceFollowsTheMeanLikelihoodRatio) {
  Follower f;
  f.detect(kHere.x, kHere.y, 0, 0.6);
  EXPECT_NEAR(f.only().existence, 0.6, 1e-6);
  double n = 0.6;
  for (int k = 0; k < 4; ++k) {
    f.follow({kHere});
    const double odds = 0.99 * n / (1 - 0.99 * n) * kImageRatio;
    n = odds / (1 + odds);
    EXPECT_NEAR(f.only().existence, n, 1e-5);
  }
  // What was seen before counts: a miss of 1 to 100 against odds of 99 to 1.
  f = Follower(long_patience());
  f.detect(kHere.x, kHere.y);
  f.follow({kHere});
  n = f.only().existence;
  f.follow({});
  const double odds = 0.99 * n / (1 - 0.99 * n) / kImageRatio;
  EXPECT_NEAR(odds, 0.98, 0.01);
  EXPECT_NEAR(f.only().existence, odds / (1 + odds), 1e-5);
}

TEST(FollowedTargets, MoveAtTheirVelocity) {
  Follower f;
  f.detect(10, 12, 2);
  f.follow({{12, 12}});
  f.follow({{14, 12}});
  EXPECT_NEAR(f.only().estimate.x, 14, 1e-4);
  EXPECT_NEAR(f.only().estimate.y, 12, 1e-4);
  EXPECT_NEAR(f.only().estimate.vx, 2, 1e-4);
}

TEST(FollowedTargets, AreConfirmedByEnoughHitsAndTheirEarlierPointsWithThem) {
  Follower f;
  f.detect(kHere.x, kHere.y);
  f.follow({kHere});
  EXPECT_TRUE(f.confirmed_now().empty());
  EXPECT_FALSE(f.only().confirmed);
  f.follow({kHere});
  EXPECT_EQ(f.confirmed_now(), std::vector<std::size_t>{0});
  EXPECT_TRUE(f.only().confirmed);
  for (const auto& p : f.log().revised()) EXPECT_EQ(p.status, TrackStatus::confirmed) << p.frame;
  EXPECT_EQ(f.log().online().front().status, TrackStatus::tentative);
  EXPECT_EQ(f.log().online().back().status, TrackStatus::confirmed);
  f.follow({kHere});
  EXPECT_TRUE(f.confirmed_now().empty());
}

TEST(FollowedTargets, ThatAreTentativeEndOnTheirFirstMiss) {
  Follower f;
  f.detect(kHere.x, kHere.y);
  f.follow({kHere});
  f.follow({});
  EXPECT_TRUE(f.targets().empty());
  EXPECT_EQ(frames_of(f.log().online(), 1), (Frames{0, 1}));
}

/// Frames 0 to 3, the third of which confirms it.
Follower confirmed_target() {
  Follower f;
  f.detect(kHere.x, kHere.y);
  for (int k = 0; k < 3; ++k) f.follow({kHere});
  return f;
}

TEST(FollowedTargets, AreOnlySaidToBeConfirmedWhileTheyAreLikelyToBeThere) {
  Follower f = confirmed_target();
  f.follow({});
  EXPECT_TRUE(f.only().confirmed);
  EXPECT_LT(f.log().online().back().existence, 0.6);
  EXPECT_EQ(f.log().online().back().status, TrackStatus::tentative);
  f.follow({kHere});
  EXPECT_EQ(f.log().online().back().status, TrackStatus::confirmed);
}

TEST(FollowedTargets, ThatAreConfirmedEndOnTheLastOfTheirMissesInARow) {
  Follower f = confirmed_target();
  f.follow({}), f.follow({});
  ASSERT_EQ(f.targets().size(), 1U);
  EXPECT_EQ(f.only().misses, 2);
  f.follow({});
  EXPECT_TRUE(f.targets().empty());
  EXPECT_EQ(f.log().online().back().status, TrackStatus::halted);
}

TEST(FollowedTargets, CountTheirMissesAnewAfterAHit) {
  Follower f = confirmed_target();
  for (const bool visible : {false, true, false, true, false, false}) {
    f.follow(visible ? std::vector{kHere} : std::vector<Pixel>{});
    ASSERT_EQ(f.targets().size(), 1U);
  }
  EXPECT_EQ(f.only().misses, 2);
}

// Where a bright target has gone, its existence needs frames to fall; the end is where the sum of
// ln(e L) was greatest, whether those frames were hits or not.
TEST(FollowedTargets, EndInTheRevisedRecordWhereTheyWereLikeliestToEnd) {
  FollowedTargetsConfig config = config_of();
  config.existence = 0.01;
  Follower f(config, 10);  // a frame without the target leaves .09, .0098, ...
  f.detect(kHere.x, kHere.y);
  for (int k = 0; k < 4; ++k) f.follow({kHere});
  for (int k = 0; k < 6 && !f.targets().empty(); ++k) f.follow({});
  ASSERT_TRUE(f.targets().empty());
  const std::vector<TrackPoint> online = f.log().online(), revised = f.log().revised();
  EXPECT_GT(online.size(), revised.size() + 2);
  EXPECT_EQ(frames_of(revised, 1), (Frames{0, 1, 2, 3, 4, online.back().frame}));
  EXPECT_EQ(revised.back().status, TrackStatus::halted);
}

TEST(FollowedTargets, LoseThePointsOfTheirLastMissesInTheRevisedRecordOnly) {
  Follower f = confirmed_target();
  f.follow({});  // frame 4, before two hits: stays
  f.follow({kHere}), f.follow({kHere});
  for (const TrackPoint& p : f.log().revised()) {
    EXPECT_EQ(p.status, TrackStatus::confirmed) << p.frame;  // it was there in frame 4, too
  }
  EXPECT_EQ(f.log().online()[4].status, TrackStatus::tentative);
  f.follow({}), f.follow({}), f.follow({});  // frames 7 to 9
  ASSERT_TRUE(f.targets().empty());
  EXPECT_EQ(frames_of(f.log().revised(), 1), (Frames{0, 1, 2, 3, 4, 5, 6, 9}));
  EXPECT_EQ(f.log().revised().back().status, TrackStatus::halted);
  EXPECT_EQ(frames_of(f.log().online(), 1), (Frames{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST(FollowedTargets, EndOutsideTheFrameWhereTheyWereSeenLast) {
  Follower f;
  f.detect(31, 12, 4);
  f.follow({{35, 12}}), f.follow({{39, 12}});
  ASSERT_TRUE(f.only().confirmed);
  f.follow({});
  EXPECT_TRUE(f.targets().empty());
  EXPECT_EQ(f.log().online().back().status, TrackStatus::halted);
  EXPECT_NEAR(f.log().online().back().x, 39, 1e-4);
}

TEST(FollowedTargets, OfTwoThatMeetTheYoungerEnds) {
  Follower f;
  f.detect(10, 12);
  f.detect(20, 12, -3);
  f.follow({{10, 12}, {17, 12}});
  ASSERT_EQ(f.targets().size(), 2U);
  f.follow({{10, 12}, {14, 12}});
  ASSERT_EQ(f.targets().size(), 1U);
  EXPECT_EQ(f.only().id, 1U);
}

TEST(FollowedTargets, OfTwoThatMeetTheOlderEndsIfItAloneIsMissed) {
  Follower f;
  f.detect(10, 12);
  f.detect(22, 12, -3);
  f.follow({{10, 12}, {19, 12}});
  f.follow({{10, 12}, {16, 12}});  // both are confirmed, 6 px apart
  ASSERT_EQ(f.targets().size(), 2U);
  f.follow({{13, 12}});
  ASSERT_EQ(f.targets().size(), 1U);
  EXPECT_EQ(f.only().id, 2U);
  EXPECT_NEAR(f.only().estimate.x, 13, 1e-4);
}

TEST(FollowedTargets, OfTwoThatMeetAYoungerOneThatIsTentativeEndsEvenSo) {
  Follower f = confirmed_target();
  f.detect(20, 12, -5);
  f.follow({{15, 12}});
  ASSERT_EQ(f.targets().size(), 1U);
  EXPECT_EQ(f.only().id, 1U);
}

TEST(FollowedTargets, AreNotDetectedNearerThanTheSeparationToATrack) {
  Follower f;
  EXPECT_TRUE(f.detect(10, 12));
  EXPECT_FALSE(f.detect(15, 12));
  EXPECT_TRUE(f.detect(16, 12));
  ASSERT_EQ(f.targets().size(), 2U);
  EXPECT_EQ(f.targets()[1].id, 2U);
}

// S = min(0, S + ln L): a miss while S < 0, the end at S <= ln P_M.
TEST(FollowedTargets, OfTheRatioTestEndAtTheProbabilityOfAMiss) {
  FollowedTargetsConfig config = config_of();
  config.rule = LifeRule::likelihood_ratio;
  config.confirm_hits = 1, config.miss_probability = 0.05;
  Follower f(config, 4);
  f.detect(kHere.x, kHere.y);
  EXPECT_TRUE(f.only().confirmed);
  EXPECT_EQ(f.confirmed_now(), std::vector<std::size_t>{0});
  f.follow({kHere});
  EXPECT_EQ(f.only().support, 1);
  f.follow({});
  EXPECT_NEAR(f.only().support, 1.0 / 4, 1e-5);
  EXPECT_EQ(f.only().misses, 1);
  f.follow({});
  EXPECT_NEAR(f.only().support, 1.0 / 16, 1e-5);
  f.follow({kHere}), f.follow({kHere}), f.follow({kHere});
  EXPECT_EQ(f.only().support, 1);
  EXPECT_EQ(f.only().misses, 0);
  f.follow({}), f.follow({});
  ASSERT_EQ(f.targets().size(), 1U);
  f.follow({});  // 1 / 64 < .05
  EXPECT_TRUE(f.targets().empty());
  // Frames 2 and 3 were misses that three hits made good; 7 to 9 are the last misses.
  EXPECT_EQ(frames_of(f.log().revised(), 1), (Frames{0, 1, 2, 3, 4, 5, 6, 9}));
}

// The mass of what the ratio test declares is the odds of a target.
TEST(FollowedTargets, OfTheRatioTestStateABernoulliProbability) {
  FollowedTargetsConfig config = config_of();
  config.rule = LifeRule::likelihood_ratio;
  config.confirm_hits = 1, config.miss_probability = 1e-3;
  Follower f(config, 4);
  f.detect(kHere.x, kHere.y, 0, 3);
  EXPECT_NEAR(f.only().existence, 0.75, 1e-6);
  f.follow({});
  const double odds = 0.99 * 0.75 / (1 - 0.99 * 0.75) / 4;
  EXPECT_NEAR(f.only().existence, odds / (1 + odds), 1e-5);
  EXPECT_EQ(f.log().at(0)[0].status, TrackStatus::confirmed);
  EXPECT_EQ(f.log().at(1)[0].status, TrackStatus::tentative);  // it is below 1 / 2
}

TEST(FollowedTargets, SurviveEachFrameThatASkippedOneStandsFor) {
  Follower f(long_patience());
  f.detect(kHere.x, kHere.y, 0, 0.6);
  f.skip(9);
  f.follow({kHere});
  const double there = std::pow(0.99, 10) * 0.6;
  const double odds = there / (1 - there) * kImageRatio;
  EXPECT_NEAR(f.only().existence, odds / (1 + odds), 1e-5);
}

// Nine to one that it is there, and its own frame counts already: survival does not.
TEST(FollowedTargets, OfACueAreConfirmedAtOnce) {
  Follower f;
  f.cue(10, 12);
  f.follow({kHere});
  ASSERT_EQ(f.targets().size(), 1u);
  EXPECT_NEAR(f.only().existence, 9 * kImageRatio / (1 + 9 * kImageRatio), 1e-4);
  EXPECT_NEAR(f.only().estimate.x, 10, 0.05);
  EXPECT_EQ(f.log().at(1)[0].status, TrackStatus::confirmed);
  EXPECT_TRUE(f.confirmed_now().empty());  // nobody has said that it was there before
}

// Below 1 / 1000 after that many frames without it: longer than other tracks.
TEST(FollowedTargets, OfACueOnNothingEndWhenTheyAreHardlyThere) {
  Follower f({}, 4);  // each frame without it: a ratio of 1 / 4
  f.cue(10, 12);
  f.follow({});
  EXPECT_NEAR(f.only().existence, 9.0 / 4 / (1 + 9.0 / 4), 1e-3);
  for (int k = 0; k < 5; ++k) f.follow({});
  EXPECT_EQ(f.targets().size(), 1u);
  EXPECT_EQ(f.only().misses, 5);
  f.follow({});
  EXPECT_TRUE(f.targets().empty());
  EXPECT_EQ(f.log().at(1)[0].status, TrackStatus::confirmed);
  EXPECT_EQ(f.log().at(2)[0].status, TrackStatus::tentative);  // it is not likely to be there
  EXPECT_EQ(f.log().at(7)[0].status, TrackStatus::halted);
  EXPECT_EQ(frames_of(f.log().revised(), 1), (Frames{7}));  // its end
}

TEST(FollowedTargets, ACueUponATrackConfirmsItAndStartsNoOther) {
  Follower f;
  f.detect(kHere.x, kHere.y, 2, 0.6);
  f.cue(kHere.x + 2, kHere.y + 5.9);  // of where it is expected
  f.follow({{kHere.x + 2, kHere.y}});
  ASSERT_EQ(f.targets().size(), 1u);
  EXPECT_TRUE(f.only().confirmed);
  EXPECT_GT(f.only().existence, 0.998);  // from .9, not from .6
  EXPECT_EQ(f.log().revised()[0].status, TrackStatus::confirmed);
  f.cue(kHere.x + 4, kHere.y + 6.1);
  f.follow({{kHere.x + 4, kHere.y}});
  EXPECT_EQ(f.targets().size(), 2u);
}

}  // namespace
}  // namespace glint
