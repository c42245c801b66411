// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/identities.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace glint {
namespace {

/// Reports one peak made of one particle without a label.
void see(Identities& identities, double x, double vx, std::int64_t frame, double step,
         TrackLog& log) {
  Particles particles;
  particles.resize(1);
  particles.weight[0] = 1, particles.label[0] = 0;
  Peak peak;
  peak.mass = 1, peak.x = x, peak.vx = vx, peak.y = 20;
  peak.first = 0, peak.last = 1;
  const std::array<std::uint32_t, 1> members{0};
  identities.assign(std::span(&peak, 1), members, particles, frame, static_cast<double>(frame),
                    step, 1, 1, log);
}

TEST(Identities, ATrackCoastsAtItsVelocityOverAGapOfFrames) {
  Identities identities{IdentityConfig{}};
  TrackLog log;
  see(identities, 10, 4, 0, 1, log);
  see(identities, 22, 4, 3, 3, log);
  ASSERT_EQ(log.at(3).size(), 1u);
  EXPECT_EQ(log.at(3)[0].track_id, log.at(0)[0].track_id);
}

TEST(Identities, APeakFarFromWhereALostTrackShouldBeIsAnotherTarget) {
  Identities identities{IdentityConfig{}};
  TrackLog log;
  see(identities, 10, 4, 0, 1, log);
  see(identities, 22, 4, 1, 1, log);
  ASSERT_EQ(log.at(1).size(), 1u);
  EXPECT_NE(log.at(1)[0].track_id, log.at(0)[0].track_id);
}

}  // namespace
}  // namespace glint
