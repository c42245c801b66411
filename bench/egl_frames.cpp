// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <string>

#include "glint/bench/bench.hpp"
#include "glint/bench/engine_run.hpp"
#include "glint/engine/frames/frame_preparer.hpp"
#include "glint/engine/trackers/phd/smc_phd.hpp"
#include "glint/kernels/core/device_traffic.hpp"

namespace glint::bench {
namespace {

constexpr int kTargets = 100;

/// How large a cloud, and how many frames before and in each of the two measurements.
struct Load {
  int particles;
  std::int64_t warm_up, timed;
};

SmcPhdConfig tracker_of(const Load& load) {
  SmcPhdConfig config;
  config.particles_per_target = load.particles / kTargets;
  config.particles_max = load.particles;
  config.birth_particles = load.particles / 5;  // a cloud grows by its births alone
  return config;
}

/// One frame after the other on the device, without the scheduler.
class Run {
 public:
  Run(const MemoryScene& scene, const Device& device, const Load& load)
      : preparer_(FramesConfig{}, device),
        tracker_(tracker_of(load), device, kEngineSeed),
        source_(scene, load.warm_up + 2 * load.timed) {}

  /// Wall clock [s] of the next frames, each.
  double seconds(std::int64_t frames) {
    const auto start = std::chrono::steady_clock::now();
    for (std::int64_t i = 0; i < frames; ++i) {
      const auto next = source_.next();
      tracker_.step(preparer_.prepare(next->pixels, frame_++, next->time), log_);
    }
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    return taken.count() / static_cast<double>(frames);
  }
  const SmcPhd& tracker() const { return tracker_; }

 private:
  FramePreparer preparer_;
  SmcPhd tracker_;
  MemorySource source_;
  TrackLog log_;
  std::int64_t frame_ = 0;
};

}  // namespace

Result bench_egl_frames(const Options& options) {
  const Device& egl = *options.egl;
  const Load load = options.quick ? Load{20000, 6, 2} : Load{1000000, 8, 5};
  const auto [width, height] = options.size;
  Result result{"frames on " + egl.description() + ": " + std::to_string(width) + "x" +
                    std::to_string(height) + " uint16 in memory, smc-phd, " +
                    std::to_string(kTargets) + " targets, " + std::to_string(load.particles) +
                    " particles",
                "frame",
                {},
                {}};
  const MemoryScene scene(width, height, {.targets = kTargets});
  Run run(scene, egl, load);
  run.seconds(load.warm_up);
  const auto add = [&](const char* name, double seconds) {
    result.timings.push_back(one_timing(name, 1, seconds, load.timed));
  };
  add("frame", run.seconds(load.timed));
  time_traffic(egl, true);
  const double waited = run.seconds(load.timed);
  const DeviceTraffic all = traffic_of(egl);
  time_traffic(egl, false);
  add("frame, each piece of work waited for", waited);
  const auto frames = static_cast<double>(load.timed);
  const auto share = [&](const std::string& name, double seconds) {
    add(name.c_str(), seconds);
    result.figures.push_back({"share of " + name, seconds / waited, {}});
  };
  share("upload", all.upload / frames);
  share("kernels", all.compute / frames);
  share("read-back", all.read_back / frames);
  share("the processor", waited - (all.upload + all.compute + all.read_back) / frames);
  result.figures.push_back(
      {"MB sent a frame", static_cast<double>(all.uploaded) / frames / 1e6, {}});
  result.figures.push_back(
      {"MB read back a frame", static_cast<double>(all.read) / frames / 1e6, {}});
  result.figures.push_back(
      {"particles after the last frame", static_cast<double>(run.tracker().particle_count()), {}});
  result.figures.push_back({"targets expected in it", run.tracker().expected_targets(), {}});
  return result;
}

}  // namespace glint::bench
