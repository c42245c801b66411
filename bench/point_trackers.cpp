// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>

#include "glint/bench/bench.hpp"
#include "glint/bench/point_contests.hpp"

namespace glint::bench {

Result bench_point_trackers(const Options& options) {
  constexpr std::uint64_t kSeed = 1;
  const auto scans = std::make_shared<const PointScans>(forty_targets());
  const auto count = static_cast<double>(scans->points.size());
  Suite suite("trackers of points: 40 known targets and 52 false points a scan in 1024x256",
              "scan");
  for (const PointContest& contest : point_contests()) {
    const std::string plain = contest.tracker + ", " + contest.baseline;
    suite.add({contest.tracker, 1, count, [scans, f = contest.ours] { f(*scans, kSeed); }});
    suite.add({plain, 1, count, [scans, f = contest.plain] { f(*scans, kSeed); }});
    suite.ratio(contest.tracker + " of the plain baseline", contest.tracker, plain, {});
  }
  return measure(suite, options.quick ? Budget{3, 1} : Budget{7, 15});
}

}  // namespace glint::bench
