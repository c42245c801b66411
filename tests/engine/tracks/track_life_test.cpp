// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/tracks/track_life.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace glint {
namespace {

constexpr HitLogic kLogic{.confirm_hits = 3, .confirm_window = 4, .halt_misses = 2};

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
  EXPECT_EQ(lived(kLogic, false, "xx"), "ttc");
  EXPECT_EQ(lived({.confirm_hits = 1, .confirm_window = 1}, false, "x"), "cc");
}

TEST(TrackLifeByHits, ConfirmsWithinTheWindowOrEnds) {
  EXPECT_EQ(lived(kLogic, false, "x.x"), "tttc");
  EXPECT_EQ(lived(kLogic, false, "x..x"), "ttth");
  EXPECT_EQ(lived(kLogic, false, "..."), "ttth");
}

TEST(TrackLifeByHits, EndsAfterMissesInARow) {
  EXPECT_EQ(lived(kLogic, false, "xx.x.."), "ttcccch");
  EXPECT_EQ(lived(kLogic, true, ".x.x.."), "cccccch");
  EXPECT_EQ(lived({.confirm_hits = 1, .confirm_window = 1, .halt_misses = 0}, true, "...."),
            "ccccc");
}

TEST(TrackLifeByHits, DoesNotKnowHowLikelyTheTargetExists) {
  TrackLife life(kLogic, true);
  EXPECT_TRUE(std::isnan(life.existence()));
  life.see(kLogic, true);
  EXPECT_TRUE(std::isnan(life.existence()));
}

TEST(TrackLife, MoreHitsThanTheWindowHoldsAreRefused) {
  EXPECT_THROW(check(HitLogic{.confirm_hits = 5, .confirm_window = 4}), ConfigError);
  EXPECT_NO_THROW(check(HitLogic{.confirm_hits = 4, .confirm_window = 4}));
}

}  // namespace
}  // namespace glint
