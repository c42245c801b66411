// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "glint/engine/scheduler.hpp"

namespace glint::test {

constexpr std::int64_t kNever = 1000;
using Hook = std::function<void(std::int64_t)>;

// `frames` small frames of noise-free pixels, one a second; `hook` sees the index before each read.
struct FakeSource : Source {
  explicit FakeSource(
      std::int64_t frames, Hook h = [](std::int64_t) {})
      : count(frames), hook(std::move(h)) {}
  std::optional<SourceFrame> next() override {
    if (read == count) return std::nullopt;
    hook(read);
    auto pixels = std::make_shared<std::vector<float>>(16 * 12);
    for (std::size_t i = 0; i < pixels->size(); ++i) (*pixels)[i] = float((i * 37 + read) % 11);
    SourceFrame frame;
    frame.pixels = {pixels->data(), 16, 12, 1, 16};
    frame.owner = pixels;
    frame.time = static_cast<double>(read++);
    return frame;
  }
  std::int64_t count;
  Hook hook;
  std::atomic<std::int64_t> read = 0;
};

// Reports `tracks` points a frame and revises the frame before.
struct FakeTracker : Tracker {
  explicit FakeTracker(
      std::int64_t n, Hook h = [](std::int64_t) {})
      : tracks(n), hook(std::move(h)) {}
  Feed feed() const override { return Feed::frames; }
  void step(const Scan& scan, TrackLog& log) override {
    hook(scan.frame);
    for (std::int64_t id = tracks; id-- > 0;) {
      TrackPoint p;
      p.frame = scan.frame;
      p.time = scan.time;
      p.track_id = id;
      p.x = sum += static_cast<double>(scan.frame + id);
      log.report(p);
      p.frame = scan.frame - 1;
      if (p.frame >= 0) log.revise(p);
    }
  }
  void finish(TrackLog& log) override { log.confirm(0, 0); }
  std::int64_t tracks;
  Hook hook;
  double sum = 0;
};

struct FakeSink : Sink {
  explicit FakeSink(Hook h = [](std::int64_t) {}) : hook(std::move(h)) {}
  void take(const ScanResult& result) override {
    hook(result.scan.frame);
    frames.push_back(result.scan.frame);
    for (const auto& points : result.reported) {
      counts.push_back(points.size());
      for (const TrackPoint& p : points) EXPECT_EQ(p.frame, result.scan.frame);
    }
  }
  Hook hook;
  std::vector<std::int64_t> frames;
  std::vector<std::size_t> counts;
};

inline std::vector<std::int64_t> first(std::int64_t n) {
  std::vector<std::int64_t> frames;
  for (std::int64_t f = 0; f < n; ++f) frames.push_back(f);
  return frames;
}

inline Hook throws_at(std::int64_t when, const std::string& message) {
  return [when, message](std::int64_t frame) {
    if (frame == when) throw std::runtime_error(message);
  };
}

inline Scheduler scheduler_on(const Device& device) {
  FramesConfig frames;
  frames.background = BackgroundKind::none;
  return {device, FramePreparer(frames, device)};
}

inline std::string error_of(Scheduler& scheduler, Source& source) {
  try {
    scheduler.run(source);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "none";
}

struct SchedulerTest : ::testing::TestWithParam<int> {
  // More threads than the machine has cores are only had with this.
  tbb::global_control control{tbb::global_control::max_allowed_parallelism, 8};
  // 0 is the serial device.
  Device device = GetParam() == 0 ? Device::serial() : Device::tbb(GetParam());
  Scheduler scheduler = scheduler_on(device);
  FakeSink sink;
};

}  // namespace glint::test
