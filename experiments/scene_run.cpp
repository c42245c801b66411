// SPDX-License-Identifier: Apache-2.0
#include "glint/experiments/scene_run.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "glint/engine/metrics/by_frame.hpp"

namespace glint {
namespace {

void note_frame(const std::vector<TruthPoint>& truth, const std::vector<TrackPoint>& reported,
                const EvaluationOptions& options, std::size_t frame,
                std::vector<TargetRecord>& targets) {
  for (const Match& pair :
       match(positions(truth), positions(reported), options.cutoff, options.order)) {
    const auto id = truth[static_cast<std::size_t>(pair.truth)].track_id;
    TargetRecord& target = targets[static_cast<std::size_t>(id)];
    target.error[frame] = pair.distance;
    target.modes[frame] = reported[static_cast<std::size_t>(pair.estimate)].mode_probability;
  }
}

/// A track ends where its tracker says so, or else at the frame after its last point.
void note_halts(const Evaluation& scores, const std::vector<TrackPoint>& points, int frames,
                std::vector<TargetRecord>& targets) {
  std::map<std::int64_t, std::int64_t> ends;
  for (const TrackPoint& point : points) {
    ends[point.track_id] = point.status == TrackStatus::halted ? point.frame : point.frame + 1;
  }
  for (const auto& [track, truth] : scores.counts_for) {
    if (!truth || ends[track] >= frames) continue;
    double& halted = targets[static_cast<std::size_t>(*truth)].halted;
    halted = std::fmax(halted, static_cast<double>(ends[track]));
  }
}

SceneScore score(const Scene& scene, const std::vector<TrackPoint>& points, bool tentative) {
  EvaluationOptions options;
  options.include_tentative = tentative;
  options.frames = scene.frames;
  SceneScore result;
  const std::vector<TruthPoint> truth = truth_of(scene);
  result.scores = evaluate(truth, points, options);
  result.consistency = consistency(truth, points);
  const auto frames = static_cast<std::size_t>(scene.frames);
  result.targets.assign(scene.targets.size(), {std::vector<double>(frames, kUndefined),
                                               std::vector<ModeProbability>(frames)});
  note_halts(result.scores, points, scene.frames, result.targets);
  std::vector<TrackPoint> kept;
  for (const TrackPoint& point : points) {
    if (is_scored(point, tentative)) kept.push_back(point);
  }
  const auto reported = by_frame(std::span<const TrackPoint>(kept), scene.frames);
  for (std::size_t k = 0; k < frames; ++k) {
    note_frame(truth_at(scene, static_cast<int>(k)), reported[k], options, k, result.targets);
  }
  return result;
}

}  // namespace

Scan whitened_scan(const Scene& scene, std::uint64_t seed, int frame) {
  Scan scan;
  scan.frame = frame;
  scan.time = frame * scene.interval;
  scan.whitened = Frame(render(scene, seed, frame));
  return scan;
}

SceneRun run_scene(const Scene& scene, const TrackerSetup& setup, std::uint64_t seed,
                   const SceneRunOptions& options) {
  const std::unique_ptr<Tracker> tracker =
      setup.make(options.device ? *options.device : Device::tbb(1), seed);
  TrackLog log;
  SceneRun run;
  for (int k = 0; k < scene.frames; ++k) {
    tracker->step(whitened_scan(scene, seed, k), log);
    run.targets.push_back(static_cast<int>(truth_at(scene, k).size()));
    if (options.observe) run.observed.push_back(options.observe(*tracker));
  }
  tracker->finish(log);
  run.online = score(scene, log.online(), options.include_tentative);
  run.revised = score(scene, log.revised(), options.include_tentative);
  run.mode_names = log.mode_names();
  return run;
}

}  // namespace glint
