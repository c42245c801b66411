// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>

#include "glint/bench/bench.hpp"
#include "glint/engine/scenario/scenes.hpp"
#include "glint/engine/trackers/registry.hpp"

namespace glint::bench {
namespace {

constexpr int kScans = 40;
constexpr std::uint64_t kSeed = 1;

// The infrared-like clip, prepared once: trackers are timed, not the way to them.
std::vector<Scan> prepared_scans() {
  IrClipScene config;
  config.frames = kScans;
  SceneSource source(make_scene(config), kSeed);
  FramePreparer preparer(FramesConfig{}, Device::tbb());
  std::vector<Scan> scans;
  while (const auto frame = source.next()) {
    scans.push_back(
        preparer.prepare(frame->pixels, static_cast<std::int64_t>(scans.size()), frame->time));
  }
  return scans;
}

void track(const TrackerEntry& entry, const Device& device, const std::vector<Scan>& scans) {
  const auto tracker = entry.make(entry.config(), device, kSeed);
  TrackLog log;
  for (const Scan& scan : scans) tracker->step(scan, log);
  tracker->finish(log);
}

Result bench_on_frames(const Options& options) {
  Suite suite("trackers on the scene ir-clip, frames prepared before", "scan");
  const auto scans = std::make_shared<const std::vector<Scan>>(prepared_scans());
  for (const TrackerEntry& entry : all_trackers()) {
    const std::string name(entry.name);
    suite.add_threads(name, kScans,
                      [&entry, scans](const Device& device) { track(entry, device, *scans); });
    suite.add(
        {name + " serial", 1, kScans, [&entry, scans] { track(entry, Device::serial(), *scans); }});
    suite.ratio_of_threads(name + " of the serial device", name, name + " serial", {}, {});
    suite.scaling(name, {});
  }
  return measure(suite, options.quick ? Budget{3, 1} : Budget{9, 20});
}

}  // namespace

std::vector<Result> bench_trackers(const Options& options) {
  std::vector<Result> results;
  for (Result (*const run)(const Options&) : {bench_point_trackers, bench_on_frames}) {
    results.push_back(run(options));
    if (options.done) options.done(results.back());
  }
  return results;
}

}  // namespace glint::bench
