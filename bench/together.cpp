// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/together.hpp"

#include <algorithm>
#include <array>

#include "glint/bench/bench.hpp"
#include "glint/bench/engine_run.hpp"

namespace glint::bench {
namespace {

constexpr double kMostOfTheSlower = 1.15;
constexpr std::int64_t kKept = 60;  // frames in the logs
constexpr int kThreads = 2;

// Of 1024x1024 pixels of noise about 40 a frame exceed it, and a target of 10 dB in 95 of 100.
PointsConfig dim_points() {
  PointsConfig points;
  points.threshold = 4;
  return points;
}

struct Run {
  std::string name;
  std::shared_ptr<WarmEngine> engine;
};

void add_stages(const Run& run, Result& result) {
  const auto frames = static_cast<double>(run.engine->scheduler().frames());
  for (const StageTime& stage : run.engine->scheduler().stage_times()) {
    result.timings.push_back(one_timing(run.name + ": " + stage.stage, kThreads,
                                        stage.seconds / frames, run.engine->scheduler().frames()));
  }
}

}  // namespace

MemoryScene dim_stream() { return {1024, 1024, {64, 64, 20, 10}}; }

WarmEngine::WarmEngine(std::shared_ptr<const MemoryScene> scene,
                       const std::vector<std::string>& trackers, const Device& device)
    : scene_(std::move(scene)),
      source_(*scene_, 0),
      scheduler_(device, FramePreparer(FramesConfig{}, device), dim_points()) {
  for (const std::string& name : trackers) scheduler_.add(make_tracker(name, device), name);
  scheduler_.keep(kKept);
}

void WarmEngine::advance(std::int64_t frames) {
  source_.extend(frames);
  scheduler_.advance(source_);
}

Result bench_together(const Options& options) {
  const auto scene = std::make_shared<const MemoryScene>(dim_stream());
  const Device device = Device::tbb(kThreads);
  const auto run = [&](std::string name, const std::vector<std::string>& trackers) {
    return Run{std::move(name), std::make_shared<WarmEngine>(scene, trackers, device)};
  };
  const std::array runs{run("mm-phd alone", {"mm-phd"}), run("pmht-imm alone", {"pmht-imm"}),
                        run("together", {"mm-phd", "pmht-imm"})};
  Suite suite("two trackers on one stream of 1024x1024 uint16 in memory", "frame");
  const std::int64_t frames = options.quick ? 16 : 48;
  for (const Run& r : runs) {
    r.engine->advance(FramesConfig{}.background_frames);
    suite.add({r.name, kThreads, static_cast<double>(frames),
               [engine = r.engine, frames] { engine->advance(frames); }});
  }
  Result result = measure(suite, options.quick ? Budget{3, 2} : Budget{15, 30});
  const auto& timed = result.timings;
  const double slower = std::max(timed[0].seconds, timed[1].seconds);
  result.figures.push_back({"time of both over that of the slower",
                            timed[2].seconds / slower,
                            {{}, kMostOfTheSlower, true}});
  for (const Run& r : runs) add_stages(r, result);
  return result;
}

}  // namespace glint::bench
