// SPDX-License-Identifier: Apache-2.0
#include "glint/experiments/aircraft_run.hpp"

#include <cmath>
#include <utility>

#include "glint/engine/metrics/evaluation.hpp"
#include "glint/engine/metrics/hit.hpp"
#include "glint/engine/scenario/scenes.hpp"
#include "glint/kernels/prepare_frame/prepare_frame.hpp"

namespace glint {
namespace {

constexpr int kScans = 21, kStride = 2;  // P-HPMHT section 4: the first scan is the start

/// The frame as P-HPMHT (2) makes it.
Scan scan_of(const Scene& scene, std::uint64_t seed, int frame, const Device& device) {
  const Image<float> image = render(scene, seed, frame);
  const FrameView view = image.view();
  Image<float> reciprocal(view.width, view.height);
  const auto floor = static_cast<float>(FramesConfig{}.reciprocal_floor);
  device.run<ToGrey>({{view.data, view.width, view.height, 1, view.pitch},
                      true,
                      floor,
                      reciprocal.view(),
                      nullptr});
  Scan scan;
  scan.frame = frame, scan.time = frame * scene.interval;
  scan.raw = Frame(std::move(reciprocal));
  return scan;
}

template <class T, class Config>
AircraftRun run(int scenario, const Config& config, std::uint64_t seed, AircraftStart start,
                const Device& device) {
  AircraftScene settings;
  settings.scenario = scenario;
  settings.variant = static_cast<int>(seed);
  const Scene scene = make_scene(settings);
  T tracker(config, device, seed);
  const TruthPoint first = truth_at(scene, 0)[0];
  const TruthPoint second =
      start == AircraftStart::two_scans ? truth_at(scene, kStride)[0] : first;  // else at rest
  tracker.start(first.x, first.y, (second.x - first.x) / kStride, (second.y - first.y) / kStride);
  TrackLog log;
  double hit = 0, distance = 0, seen = 0;
  for (int k = 0; k < kScans; ++k) {
    const int frame = k * kStride;
    tracker.step(scan_of(scene, seed, frame, device), log);
    const auto reported = log.at(frame);
    if (k == 0 || reported.empty() || reported[0].status == TrackStatus::halted) continue;
    const TruthPoint truth = truth_at(scene, frame)[0];
    ++seen;
    distance += std::hypot(reported[0].x - truth.x, reported[0].y - truth.y);
    hit += hits({reported[0].x, reported[0].y}, patch_at(scene, 0, frame));
  }
  return {100 * hit / (kScans - 1), seen > 0 ? distance / seen : kUndefined};
}

}  // namespace

AircraftRun run_aircraft(int scenario, const HPmhtConfig& config, std::uint64_t seed,
                         AircraftStart start, const Device& device) {
  return run<HPmht>(scenario, config, seed, start, device);
}

AircraftRun run_aircraft(int scenario, const ImmPdaAiConfig& config, std::uint64_t seed,
                         AircraftStart start, const Device& device) {
  return run<ImmPdaAi>(scenario, config, seed, start, device);
}

}  // namespace glint
