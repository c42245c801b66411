// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/experiments/clip_run.hpp"

#include <memory>
#include <utility>

#include "glint/engine/scenario/scenario.hpp"
#include "glint/engine/trackers/registry.hpp"
#include "glint/frontends/files/noisy_source.hpp"
#include "glint/frontends/files/open_source.hpp"

namespace glint {
namespace {

constexpr double kClipCutoff = 8;  // [px]; box centres lie up to 3 px off the peaks

/// The points of every frame, as the single-frame detector's.
class Detections : public Sink {
 public:
  void take(const ScanResult& result) override {
    for (const PointMeasurement& p : result.scan.points) {
      list.push_back({result.scan.frame, p.x, p.y, p.amplitude});
    }
  }
  std::vector<Detection> list;
};

std::unique_ptr<Source> open(const ClipInput& clip, std::uint64_t seed, const Device& device) {
  auto source = open_source(std::span(&clip.frames, 1));
  if (clip.noise == 0) return source;
  return std::make_unique<NoisySource>(std::move(source), clip.noise, seed, device);
}

Scheduler scheduler_of(FramePreparer preparer, std::span<const ClipTracker> trackers,
                       std::uint64_t seed, const Device& device) {
  Scheduler scheduler(device, std::move(preparer));
  for (const ClipTracker& t : trackers) {
    scheduler.add(find_tracker(t.name).make(t.config, device, seed), t.name);
  }
  return scheduler;
}

}  // namespace

std::vector<ClipScore> run_clip(const ClipInput& clip, const FramesConfig& frames,
                                std::span<const ClipTracker> trackers, std::uint64_t seed) {
  const Device device = Device::tbb(1);
  FramePreparer preparer(frames, device);
  if (frames.background_prime > 0) {
    prime_background(preparer, *open(clip, seed, device), frames.background_prime);
  }
  Scheduler scheduler = scheduler_of(std::move(preparer), trackers, seed, device);
  Detections detections;
  scheduler.find_points();
  scheduler.add(detections);
  const auto source = open(clip, seed, device);
  EvaluationOptions options{.cutoff = kClipCutoff, .frames = scheduler.run(*source)};

  std::vector<ClipScore> scores;
  for (const TrackLog* log : scheduler.logs()) {
    ClipScore score{evaluate(clip.truth, log->online(), options),
                    evaluate(clip.truth, log->revised(), options),
                    {}};
    score.baseline = detector_baseline(clip.truth, detections.list,
                                       score.online.false_points_per_frame, options);
    scores.push_back(std::move(score));
  }
  return scores;
}

std::vector<int> tracks_in_noise(const ClipSize& size, const FramesConfig& frames,
                                 std::span<const ClipTracker> trackers, std::uint64_t seed) {
  const Device device = Device::tbb(1);
  Scene noise;
  noise.width = size.width, noise.height = size.height, noise.frames = size.frames;
  SceneSource source(std::move(noise), seed);
  Scheduler scheduler = scheduler_of(FramePreparer(frames, device), trackers, seed, device);
  scheduler.run(source);
  std::vector<int> tracks;
  for (const TrackLog* log : scheduler.logs()) tracks.push_back(evaluate({}, log->online()).tracks);
  return tracks;
}

}  // namespace glint
