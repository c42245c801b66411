// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <memory>
#include <string>

#include "glint/bench/bench.hpp"
#include "glint/bench/memory_source.hpp"
#include "glint/engine/trackers/registry.hpp"

namespace glint::bench {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::uint64_t kSeed = 1;
constexpr const char* kTracker = "smc-phd";

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::unique_ptr<Tracker> make_tracker(const Device& device) {
  const TrackerEntry& entry = find_tracker(kTracker);
  return entry.make(entry.config(), device, kSeed);
}

// Notes when the last frame of the warm-up and the last frame of all came out.
class Stopwatch : public Sink {
 public:
  explicit Stopwatch(std::int64_t warm_up) : warm_up_(warm_up) {}
  void take(const ScanResult& result) override {
    if (result.scan.frame < warm_up_) {
      start_ = Clock::now();
    } else {
      ++frames_;
      seconds_ = seconds_since(start_);
    }
  }
  double seconds_a_frame() const { return seconds_ / static_cast<double>(frames_); }

 private:
  std::int64_t warm_up_, frames_ = 0;
  double seconds_ = 0;
  Clock::time_point start_;
};

Timing timing(std::string name, int threads, double seconds_a_frame, std::int64_t frames) {
  return {std::move(name),          threads, seconds_a_frame, 1 / seconds_a_frame,
          static_cast<int>(frames), 0};
}

// The pipeline as `glint track` runs it.
void run_engine(const MemoryScene& scene, const Device& device, std::int64_t warm_up,
                std::int64_t timed, Result& result) {
  Scheduler scheduler(device, FramePreparer(FramesConfig{}, device));
  scheduler.add(make_tracker(device), kTracker);
  Stopwatch stopwatch(warm_up);
  scheduler.add(stopwatch);
  MemorySource source(scene, warm_up + timed);
  const auto frames = static_cast<double>(scheduler.run(source));
  const int threads = device.workers().threads();
  result.timings.push_back(timing("engine", threads, stopwatch.seconds_a_frame(), timed));
  double all = 0;
  for (const StageTime& stage : scheduler.stage_times()) all += stage.seconds;
  for (const StageTime& stage : scheduler.stage_times()) {
    result.timings.push_back(
        timing("stage: " + stage.stage, threads, stage.seconds / frames, timed));
    result.figures.push_back({"share of the stage " + stage.stage, stage.seconds / all, {}});
  }
}

// The same work, one frame after the other: what the kernels alone take.
double run_kernels(const MemoryScene& scene, const Device& plain, std::int64_t warm_up,
                   std::int64_t timed, Result& result) {
  KernelClock clock;
  const Device device = plain.timed_by(clock);
  FramePreparer preparer(FramesConfig{}, device);
  const auto tracker = make_tracker(device);
  TrackLog log;
  MemorySource source(scene, warm_up + timed);
  for (std::int64_t frame = 0; const auto next = source.next(); ++frame) {
    if (frame == warm_up) clock.reset();
    tracker->step(preparer.prepare(next->pixels, frame, next->time), log);
  }
  double all = 0;
  for (const auto& [kernel, seconds] : clock.seconds()) {
    const double each = seconds / static_cast<double>(timed);
    result.timings.push_back(timing("kernel: " + kernel, device.workers().threads(), each, timed));
    all += each;
  }
  result.timings.push_back(timing("all kernels", device.workers().threads(), all, timed));
  return all;
}

}  // namespace

std::vector<Result> bench_frames(const Options& options) {
  const auto [width, height] = options.size;
  Result result{"frames: whole engine, " + std::to_string(width) + "x" + std::to_string(height) +
                    " uint16 in memory, " + kTracker,
                "frame",
                {},
                {}};
  const std::int64_t warm_up = options.quick ? 24 : FramesConfig{}.background_frames;
  const std::int64_t timed = options.quick ? 24 : 60;
  const MemoryScene scene(width, height);
  const Device device = Device::tbb();
  run_engine(scene, device, warm_up, timed, result);
  const double engine = result.timings.front().seconds;
  const double kernels = run_kernels(scene, device, warm_up, timed, result);
  result.figures.push_back(
      {"rate of the engine over that of its kernels", kernels / engine, {.8, .8}});
  if (options.done) options.done(result);
  return {result};
}

}  // namespace glint::bench
