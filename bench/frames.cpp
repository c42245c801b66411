// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "glint/bench/bench.hpp"
#include "glint/bench/engine_run.hpp"

namespace glint::bench {
namespace {

constexpr const char* kTracker = "smc-phd";

// The same work, one frame after the other: what the kernels alone take.
double run_kernels(const MemoryScene& scene, const Device& plain, const RunLength& length,
                   Result& result) {
  KernelClock clock;
  const Device device = plain.timed_by(clock);
  FramePreparer preparer(FramesConfig{}, device);
  const auto tracker = make_tracker(kTracker, device);
  TrackLog log;
  MemorySource source(scene, length.warm_up + length.timed);
  for (std::int64_t frame = 0; const auto next = source.next(); ++frame) {
    if (frame == length.warm_up) clock.reset();
    tracker->step(preparer.prepare(next->pixels, frame, next->time), log);
  }
  const int threads = device.workers().threads();
  double all = 0;
  for (const auto& [kernel, seconds] : clock.seconds()) {
    const double each = seconds / static_cast<double>(length.timed);
    result.timings.push_back(one_timing("kernel: " + kernel, threads, each, length.timed));
    all += each;
  }
  result.timings.push_back(one_timing("all kernels", threads, all, length.timed));
  return all;
}

Result bench_engine(const Options& options) {
  const auto [width, height] = options.size;
  Result result{"frames: whole engine, " + std::to_string(width) + "x" + std::to_string(height) +
                    " uint16 in memory, " + kTracker,
                "frame",
                {},
                {}};
  const RunLength length =
      options.quick ? RunLength{24, 24} : RunLength{FramesConfig{}.background_frames, 60};
  const MemoryScene scene(width, height, {});
  const Device device = Device::tbb();
  const double engine = run_engine(scene, kTracker, device, length, "engine", result).seconds;
  const double kernels = run_kernels(scene, device, length, result);
  result.figures.push_back(
      {"rate of the engine over that of its kernels", kernels / engine, {.8, .8}});
  return result;
}

}  // namespace

std::vector<Result> bench_frames(const Options& options) {
  using Bench = Result (*)(const Options&);
  std::vector<Bench> benches{bench_engine, bench_together};
  if (options.egl) benches = {bench_egl_frames};
  std::vector<Result> results;
  for (const Bench run : benches) {
    results.push_back(run(options));
    if (options.done) options.done(results.back());
  }
  return results;
}

}  // namespace glint::bench
