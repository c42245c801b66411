// SPDX-License-Identifier: Apache-2.0
// Warm trackers of points allocate nothing. An executable of its own: it counts every operator new.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

#include "counted_allocations.hpp"
#include "glint/bench/endless_points.hpp"
#include "glint/engine/trackers/imm_pda_ai/imm_pda_ai.hpp"
#include "glint/engine/trackers/jpda/imm_jpda.hpp"
#include "glint/engine/trackers/pmht/mmpf_pmht.hpp"
#include "glint/engine/trackers/pmht/pmht.hpp"

namespace glint {
namespace {

// What a run over an endless stream of points allocated once it was warm.
struct Counted {
  std::size_t allocations = 0;
  std::int64_t started = 0;  // tracks
  std::size_t reported = 0;  // tracks at the end
};

struct Length {
  std::int64_t warm_up = 200, scans = 300;
};

// Clusters of crossing targets are as large as any only now and then.
constexpr Length kCrossings{1000, 1100};
constexpr std::int64_t kKept = 20;

// Twice as many false points while it warms up, so that no later scan asks for more room.
template <class T>
Counted follow(T& tracker, Length length) {
  bench::EndlessPoints dense(length.scans, 0.04), usual(length.scans);
  TrackLog log;
  log.reserve(50000);
  Counted counted;
  std::int64_t newest = 0, warm = 0;
  Scan scan;
  for (; scan.frame < length.scans; ++scan.frame) {
    const auto more = dense.next(), fewer = usual.next();
    const bool is_warm = scan.frame >= length.warm_up;
    const auto& frame = is_warm ? fewer : more;
    scan.time = frame->time, scan.points = *frame->points;
    const std::size_t before = test::allocations;
    tracker.step(scan, log);
    log.forget(scan.frame - kKept);
    if (is_warm) counted.allocations += test::allocations - before;
    const std::vector<TrackPoint> points = log.at(scan.frame);
    for (const TrackPoint& point : points) newest = std::max(newest, point.track_id);
    if (!is_warm) warm = newest;
    counted.reported = points.size();
  }
  counted.started = newest - warm;
  return counted;
}

template <class T, class Config>
struct Case {
  static Counted known(Length length) {
    Config config;
    config.initiate = false;
    if constexpr (std::is_base_of_v<PointTrackConfig, Config>) {
      keep_to_known(config);
    } else {
      config.life.halt_misses = 1000, config.separation = 0;
    }
    T tracker(config, Device::tbb(1), 1);
    for (const Kinematics& k : bench::EndlessPoints(1).starts()) {
      tracker.start(k.x, k.y, k.vx, k.vy);
    }
    return follow(tracker, length);
  }
  static Counted by_itself(Length length) {
    T tracker(Config{}, Device::tbb(1), 1);
    return follow(tracker, length);
  }
};

struct Entry {
  const char* name;
  std::size_t a_start;  // most allocations of a track that starts
  Length length;
  Counted (*known)(Length);
  Counted (*by_itself)(Length);
};

template <class T, class Config>
constexpr Entry entry(const char* name, std::size_t a_start, Length length = {}) {
  return {name, a_start, length, Case<T, Config>::known, Case<T, Config>::by_itself};
}

struct RestartConfig : ImmMscanJpdaConfig {
  RestartConfig() { reading = WindowReading::restart; }
};
struct UnlikeConfig : ImmJpdaConfig {
  UnlikeConfig() { motion = "ncv+wpa+wpa"; }
};

std::ostream& operator<<(std::ostream& out, const Entry& entry) { return out << entry.name; }

class PointAllocation : public testing::TestWithParam<Entry> {};
INSTANTIATE_TEST_SUITE_P(
    Trackers, PointAllocation,
    testing::Values(entry<ImmPdaAi, ImmPdaAiConfig>("imm_pda_ai", 0),
                    entry<ImmJpda, ImmJpdaConfig>("imm_jpda", 1, kCrossings),
                    entry<ImmJpda, UnlikeConfig>("imm_jpda_unlike", 1, kCrossings),
                    entry<ImmJpda, ImmMscanJpdaConfig>("imm_mscan_jpda", 1, kCrossings),
                    entry<ImmJpda, RestartConfig>("imm_mscan_jpda_restart", 4, kCrossings),
                    entry<Pmht, PmhtConfig>("pmht_imm", 2), entry<Pmht, PmhtCaConfig>("pmht_ca", 1),
                    entry<Pmht, PmhtSingerConfig>("pmht_singer", 1),
                    entry<Pmht, PmhtHomotheticConfig>("pmht_homothetic", 2),
                    entry<MmpfPmht, MmpfPmhtConfig>("mmpf_pmht", 9, {40, 60})),
    [](const auto& of) { return of.param.name; });

TEST_P(PointAllocation, NoneWithKnownTargets) {
  const Counted counted = GetParam().known(GetParam().length);
  EXPECT_EQ(counted.allocations, 0u);
  EXPECT_EQ(counted.reported, 40u);
}

// Whatever the number of points, targets and scans.
TEST_P(PointAllocation, AFewWhereATrackStarts) {
  const Counted counted = GetParam().by_itself(GetParam().length);
  RecordProperty("allocations", std::to_string(counted.allocations));
  RecordProperty("started", std::to_string(counted.started));
  EXPECT_LE(counted.allocations, GetParam().a_start * static_cast<std::size_t>(counted.started));
  EXPECT_GE(counted.reported, 30u);
  EXPECT_GE(counted.started, 10);
}

}  // namespace
}  // namespace glint
