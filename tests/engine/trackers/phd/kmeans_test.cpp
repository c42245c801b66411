// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/kmeans.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/trackers/phd/few_particles.hpp"

namespace glint {
namespace {

using namespace test;

/// The states by rising x, for whatever seeds the key draws.
std::vector<Peak> states_of(const Particles& p, std::uint64_t seed,
                            std::vector<std::uint32_t>& members) {
  auto states = kmeans_states(p, random_key(seed, 0, Purpose::kmeans), members);
  std::ranges::sort(states, {}, &Peak::x);
  return states;
}

// P-PHD section 3.1: round(n) classes, each with the weighted mean of its particles as state.
TEST(Kmeans, SplitsParticlesIntoTheRoundedMass) {
  const Particles p = particles_of({{.x = 10, .y = 5, .vx = 1, .weight = 0.6F},
                                    {.x = 12, .y = 5, .vx = 1, .weight = 0.2F},
                                    {.x = 50, .y = 40, .vx = -1, .weight = 0.4F},
                                    {.x = 50, .y = 44, .vx = -3, .weight = 0.4F}});
  std::vector<std::uint32_t> members;
  const auto states = states_of(p, 3, members);
  ASSERT_EQ(states.size(), 2U);
  EXPECT_NEAR(states[0].x, 10.5, 1e-6);
  EXPECT_NEAR(states[0].mass, 0.8, 1e-6);
  EXPECT_NEAR(states[1].y, 42, 1e-6);
  EXPECT_NEAR(states[1].vx, -2, 1e-6);
  EXPECT_NEAR(states[1].var_y, 4, 1e-6);
}

TEST(Kmeans, ListsTheMembersOfEachStateInItsRange) {
  const Particles p = particles_of({{.x = 10, .weight = 0.5F},
                                    {.x = 50, .weight = 1},
                                    {.x = 11, .weight = 0.5F},
                                    {.x = 12, .weight = 0}});
  std::vector<std::uint32_t> members;
  const auto states = states_of(p, 3, members);
  ASSERT_EQ(states.size(), 2U);
  const auto of = [&](const Peak& s) {
    return std::vector(members.begin() + static_cast<std::ptrdiff_t>(s.first),
                       members.begin() + static_cast<std::ptrdiff_t>(s.last));
  };
  EXPECT_EQ(of(states[0]), (std::vector<std::uint32_t>{0, 2}));  // none without weight
  EXPECT_EQ(of(states[1]), (std::vector<std::uint32_t>{1}));
}

TEST(Kmeans, OfLessThanHalfATargetIsNone) {
  std::vector<std::uint32_t> members{1, 2};
  EXPECT_TRUE(states_of(particles_of({{.x = 10, .weight = 0.4F}}), 1, members).empty());
  EXPECT_TRUE(members.empty());
  EXPECT_TRUE(states_of(Particles{}, 1, members).empty());
  EXPECT_EQ(states_of(particles_of({{.x = 10, .weight = 0.6F}}), 1, members).size(), 1U);
}

}  // namespace
}  // namespace glint
