// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "glint/engine/engine.hpp"
#include "glint/engine/trackers/registry.hpp"

namespace glint::test {

constexpr int kWidth = 48, kHeight = 32, kFrames = 25;

/// A bright target that moves to the right over ripples [grey levels].
inline std::vector<std::uint16_t> picture(int frame) {
  std::vector<std::uint16_t> pixels;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double dx = x - 8 - 1.2 * frame, dy = y - 10 - 0.5 * frame;
      const int ripple = (7 * x + 5 * y + 11 * frame + x * y) % 23;
      const double light = 100 + ripple + 90 * std::exp(-dx * dx - dy * dy);
      pixels.push_back(static_cast<std::uint16_t>(light));
    }
  }
  return pixels;
}

inline std::vector<TrackPoint> points_of(const EngineResult& result) {
  return {result.tracks.begin(), result.tracks.end()};
}

/// What the engine itself reports of the clip with a tracker's default settings.
inline std::vector<EngineResult> engine_results(const char* name) {
  const Device device = Device::tbb();
  Scheduler scheduler(device, FramePreparer(FramesConfig{}, device));
  const TrackerEntry& tracker = find_tracker(name);
  scheduler.add(tracker.make(tracker.config(), device, 1));
  Engine engine(std::move(scheduler));
  for (int f = 0; f < kFrames; ++f) {
    const auto pixels = picture(f);
    engine.push({pixels.data(), kWidth, kHeight, 1, kWidth}, f);
  }
  engine.finish();
  std::vector<EngineResult> results;
  while (auto result = engine.poll()) results.push_back(std::move(*result));
  return results;
}

}  // namespace glint::test
