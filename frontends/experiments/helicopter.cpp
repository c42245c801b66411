// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/experiments/helicopter.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

#include "glint/engine/trackers/h_pmht/h_pmht.hpp"
#include "glint/frontends/files/cropped_source.hpp"
#include "glint/frontends/files/open_source.hpp"

namespace glint {
namespace {

constexpr int kSide = 200;       // [px]
constexpr double kReach = 10.0;  // [px]

Box box_about(const std::vector<TruthPoint>& truth) {
  const auto [left, right] = std::ranges::minmax(truth, {}, &TruthPoint::x);
  const auto [top, bottom] = std::ranges::minmax(truth, {}, &TruthPoint::y);
  const int x = static_cast<int>((left.x + right.x - kSide) / 2);
  const int y = static_cast<int>((top.y + bottom.y - kSide) / 2);
  return {x, y, x + kSide, y + kSide};
}

/// Intensity without limits: an aircraft is many sigmas darker than the sky.
FramesConfig frames_config() {
  FramesConfig config;
  config.reciprocal = true;
  config.ring = config.structure = false;
  config.clip_high = 1000;
  return config;
}

HPmhtConfig tracker_config(CellIntensity intensity) {
  HPmhtConfig config;
  config.intensity = intensity;
  config.estimate_extent = true, config.extent = 16;
  config.process_noise = 1;
  config.initiate = false;
  config.halt_count = 0;
  return config;
}

}  // namespace

AircraftClip follow_aircraft(const std::string& clip, const std::vector<TruthPoint>& truth,
                             CellIntensity intensity) {
  const Box box = box_about(truth);
  const Device device = Device::tbb(1);
  auto tracker = std::make_unique<HPmht>(tracker_config(intensity), device, 1);
  tracker->start(truth[0].x - box.x0, truth[0].y - box.y0, truth[1].x - truth[0].x,
                 truth[1].y - truth[0].y);
  Scheduler scheduler(device, FramePreparer(frames_config(), device));
  scheduler.add(std::move(tracker));
  CroppedSource source(open_source(std::span(&clip, 1)), box);
  scheduler.run(source);

  AircraftClip result;
  for (const TruthPoint& t : truth) {
    for (const TrackPoint& p : scheduler.logs()[0]->at(t.frame)) {
      const double distance = std::hypot(p.x + box.x0 - t.x, p.y + box.y0 - t.y);
      result.hit += distance <= kReach ? 1 : 0;
      result.deviation += distance;
    }
  }
  const auto frames = static_cast<double>(truth.size());
  return {100 * result.hit / frames, result.deviation / frames};
}

}  // namespace glint
