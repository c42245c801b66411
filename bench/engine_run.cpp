// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/engine_run.hpp"

#include <chrono>

#include "glint/engine/trackers/registry.hpp"

namespace glint::bench {
namespace {

using Clock = std::chrono::steady_clock;

// Notes when the last frame of the warm-up and the last frame of all came out.
class Stopwatch : public Sink {
 public:
  explicit Stopwatch(std::int64_t warm_up) : warm_up_(warm_up) {}
  void take(const ScanResult& result) override {
    tracks_ = result.reported[0].size();
    if (result.scan.frame < warm_up_) {
      start_ = Clock::now();
      return;
    }
    ++frames_;
    seconds_ = std::chrono::duration<double>(Clock::now() - start_).count();
  }
  EngineRun run() const { return {seconds_ / static_cast<double>(frames_), tracks_}; }

 private:
  std::int64_t warm_up_, frames_ = 0;
  double seconds_ = 0;
  std::size_t tracks_ = 0;
  Clock::time_point start_;
};

}  // namespace

std::unique_ptr<Tracker> make_tracker(const std::string& name, const Device& device) {
  const TrackerEntry& entry = find_tracker(name);
  return entry.make(entry.config(), device, kEngineSeed);
}

Timing one_timing(std::string name, int threads, double seconds, std::int64_t samples) {
  return {std::move(name), threads, seconds, 1 / seconds, static_cast<int>(samples), 0};
}

EngineRun run_engine(const MemoryScene& scene, const std::string& tracker, const Device& device,
                     const RunLength& length, const std::string& name, Result& result) {
  Scheduler scheduler(device, FramePreparer(FramesConfig{}, device));
  scheduler.add(make_tracker(tracker, device), tracker);
  Stopwatch stopwatch(length.warm_up);
  scheduler.add(stopwatch);
  MemorySource source(scene, length.warm_up + length.timed);
  const auto frames = static_cast<double>(scheduler.run(source));
  const int threads = device.workers().threads();
  const EngineRun run = stopwatch.run();
  result.timings.push_back(one_timing(name, threads, run.seconds, length.timed));
  double all = 0;
  for (const StageTime& stage : scheduler.stage_times()) all += stage.seconds;
  for (const StageTime& stage : scheduler.stage_times()) {
    const std::string of = name + ": " + stage.stage;
    result.timings.push_back(one_timing(of, threads, stage.seconds / frames, length.timed));
    result.figures.push_back({"share of " + of, stage.seconds / all, {}});
  }
  return run;
}

}  // namespace glint::bench
