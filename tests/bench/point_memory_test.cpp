// SPDX-License-Identifier: Apache-2.0
// Trackers of points on a stream without an end. An executable of its own: it counts every
// operator new.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "counted_allocations.hpp"
#include "glint/bench/endless_points.hpp"
#include "glint/engine/trackers/registry.hpp"

namespace glint {

inline void PrintTo(const TrackerEntry& entry, std::ostream* out) { *out << entry.name; }

namespace {

// What is live on the heap as scans go by, and how many tracks are reported.
class Watch : public Sink {
 public:
  Watch(std::int64_t from, std::int64_t to) : from_(from), to_(to) {}
  void take(const ScanResult& result) override {
    const std::int64_t frame = result.scan.frame;
    if (frame == from_) at_from_ = test::live_bytes, allocations_ = test::allocations;
    if (frame + 1 != to_) return;
    at_to_ = test::live_bytes, allocations_ = test::allocations - allocations_;
    tracks_ = result.reported[0].size();
  }
  double grown() const { return static_cast<double>(at_to_) - static_cast<double>(at_from_); }
  double live() const { return static_cast<double>(at_to_); }
  double allocations_a_scan() const {
    return static_cast<double>(allocations_) / static_cast<double>(to_ - from_);
  }
  std::size_t tracks() const { return tracks_; }

 private:
  std::int64_t from_, to_;
  std::size_t at_from_ = 0, at_to_ = 0, allocations_ = 0, tracks_ = 0;
};

Watch follow(const TrackerEntry& entry, std::int64_t from, std::int64_t scans, std::int64_t keep) {
  const Device device = Device::tbb(1);
  Scheduler scheduler(device, FramePreparer(FramesConfig{}, device));
  scheduler.add(entry.make(entry.config(), device, 1), std::string(entry.name));
  scheduler.keep(keep);
  Watch watch(from, scans);
  scheduler.add(watch);
  bench::EndlessPoints source(scans);
  EXPECT_EQ(scheduler.run(source), scans);
  return watch;
}

std::vector<TrackerEntry> trackers_of_points() {
  std::vector<TrackerEntry> some;
  for (const TrackerEntry& entry : all_trackers()) {
    if (entry.feed != Feed::frames) some.push_back(entry);
  }
  return some;
}

class PointMemory : public testing::TestWithParam<TrackerEntry> {};

std::string test_name(const testing::TestParamInfo<TrackerEntry>& info) {
  std::string name(info.param.name);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Trackers, PointMemory, testing::ValuesIn(trackers_of_points()), test_name);

TEST_P(PointMemory, IsFlatOverThousandsOfScans) {
  const std::int64_t scans = GetParam().name == "mmpf-pmht" ? 2500 : 10000;  // clouds are slow
  const Watch watch = follow(GetParam(), scans / 5, scans, 50);
  RecordProperty("live_bytes", std::to_string(watch.live()));
  RecordProperty("grown_bytes", std::to_string(watch.grown()));
  RecordProperty("allocations_a_scan", std::to_string(watch.allocations_a_scan()));
  EXPECT_LE(watch.grown(), 65536);
  EXPECT_GE(watch.tracks(), 30u);
}

}  // namespace
}  // namespace glint
