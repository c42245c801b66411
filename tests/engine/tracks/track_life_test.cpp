// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/tracks/track_life.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace glint {
namespace {

constexpr HitLogic kThreeOfFour{.confirm_hits = 3, .confirm_window = 4, .halt_misses = 2};

/// The status after the first point and after each scan of `seen`, x for a hit: t(entative),
/// c(onfirmed) or h(alted), up to the end.
std::string lived(const HitLogic& logic, bool known, const std::string& seen) {
  TrackLife life(logic, known);
  std::string statuses{"tch"[static_cast<int>(life.status())]};
  for (const char mark : seen) {
    if (life.over()) break;
    life.see(logic, mark == 'x');
    statuses += "tch"[static_cast<int>(life.status())];
  }
  return statuses;
}

TEST(TrackLifeByHits, CountsTheFirstPointAsAHit) {
  EXPECT_EQ(lived(kThreeOfFour, false, "xx"), "ttc");
  EXPECT_EQ(lived({.confirm_hits = 1, .confirm_window = 1}, false, "x"), "cc");
}

TEST(TrackLifeByHits, ConfirmsWithinTheWindowOrEnds) {
  EXPECT_EQ(lived(kThreeOfFour, false, "x.x"), "tttc");
  EXPECT_EQ(lived(kThreeOfFour, false, "x..x"), "ttth");
  EXPECT_EQ(lived(kThreeOfFour, false, "..."), "ttth");
}

TEST(TrackLifeByHits, EndsAfterMissesInARow) {
  EXPECT_EQ(lived(kThreeOfFour, false, "xx.x.."), "ttcccch");
  EXPECT_EQ(lived(kThreeOfFour, true, ".x.x.."), "cccccch");
  EXPECT_EQ(lived({.confirm_hits = 1, .confirm_window = 1, .halt_misses = 0}, true, "...."),
            "ccccc");
}

TEST(TrackLifeByHits, DoesNotKnowHowLikelyTheTargetExists) {
  TrackLife life(kThreeOfFour, true);
  EXPECT_TRUE(std::isnan(life.existence()));
  life.see(kThreeOfFour, true);
  EXPECT_TRUE(std::isnan(life.existence()));
}

TEST(TrackLife, ExistenceIsBayesRule) {
  TrackLifeConfig config;
  config.survival = 0.9, config.birth_existence = 0.2;
  TrackLife life(config, false);
  life.see(config, true, 10, 2);
  const double predicted = 0.2 * 0.81;
  EXPECT_NEAR(life.existence(), 10 * predicted / (10 * predicted + 1 - predicted), 1e-14);
}

TEST(TrackLife, ConfirmsByHitsAndExistenceTogetherInTime) {
  TrackLifeConfig config;
  config.confirm_hits = 4, config.confirm_window = 5;
  TrackLife seen(config, false), unlikely(config, false), missed(config, false);
  for (int scan = 0; scan < 2; ++scan) {
    EXPECT_EQ(seen.status(), TrackStatus::tentative);
    seen.see(config, true, 20, 1), unlikely.see(config, true, 1, 1),
        missed.see(config, false, 20, 1);
  }
  EXPECT_EQ(seen.status(), TrackStatus::confirmed);
  EXPECT_EQ(unlikely.status(), TrackStatus::tentative);
  unlikely.see(config, true, 1, 1), missed.see(config, false, 20, 1);
  EXPECT_TRUE(unlikely.over());
  EXPECT_TRUE(missed.over());
}

TEST(TrackLife, EndsByMissesOrByExistenceUnlessTold) {
  TrackLifeConfig config;
  config.halt_misses = 3, config.halt_existence = 0.02;
  TrackLife misses(config, true), fades(config, true);
  for (int scan = 0; scan < 2; ++scan)
    misses.see(config, false, 1, 1), fades.see(config, true, 0.01, 1);
  EXPECT_FALSE(misses.over());
  EXPECT_TRUE(fades.over());
  misses.see(config, false, 1, 1);
  EXPECT_TRUE(misses.over());
  config.halt_misses = 0, config.halt_existence = 0;
  TrackLife stays(config, true);
  for (int scan = 0; scan < 50; ++scan) stays.see(config, false, 0.05, 1);
  EXPECT_EQ(stays.status(), TrackStatus::confirmed);
}

TEST(TrackLife, MissesCountInARow) {
  TrackLifeConfig config;
  config.halt_misses = 3;
  TrackLife life(config, true);
  for (const bool hit : {false, false, true, false, false}) life.see(config, hit, 1, 1);
  EXPECT_FALSE(life.over());
  life.see(config, false, 1, 1);
  EXPECT_TRUE(life.over());
}

TEST(TrackLife, MoreHitsThanTheWindowHoldsAreRefused) {
  EXPECT_THROW(check(HitLogic{.confirm_hits = 5, .confirm_window = 4}), ConfigError);
  EXPECT_NO_THROW(check(HitLogic{.confirm_hits = 4, .confirm_window = 4}));
}

}  // namespace
}  // namespace glint
