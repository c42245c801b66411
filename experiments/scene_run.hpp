// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "glint/engine/filters/mode_probability.hpp"
#include "glint/engine/metrics/consistency.hpp"
#include "glint/engine/metrics/evaluation.hpp"
#include "glint/engine/scan.hpp"
#include "glint/engine/scenario/scenario.hpp"
#include "glint/experiments/evaluation_bytes.hpp"
#include "glint/experiments/tracker_setup.hpp"

namespace glint {

/// What was reported of one target, by frame.
struct TargetRecord {
  std::vector<double> error;           ///< [px]; NaN where nothing was reported within reach of it
  std::vector<ModeProbability> modes;  ///< empty there
  double halted = kUndefined;          ///< frame at which the last track that counts for it ended
};
auto fields(OneOf<TargetRecord> auto& r) { return std::tie(r.error, r.modes, r.halted); }

struct SceneScore {
  Evaluation scores;
  Consistency consistency;            ///< of all points, tentative ones included
  std::vector<TargetRecord> targets;  ///< in the order of the scene's
};
auto fields(OneOf<SceneScore> auto& s) { return std::tie(s.scores, s.consistency, s.targets); }

/// A tracker's run over a scene, as it was reported at the time and as it was revised later.
struct SceneRun {
  SceneScore online, revised;
  std::vector<std::string> mode_names;
  std::vector<int> targets;      ///< that are there, by frame
  std::vector<double> observed;  ///< by frame, if asked for
};
auto fields(OneOf<SceneRun> auto& r) {
  return std::tie(r.online, r.revised, r.mode_names, r.targets, r.observed);
}

struct SceneRunOptions {
  bool include_tentative = false;               ///< score tentative points too
  double (*observe)(const Tracker&) = nullptr;  ///< asked after every step
  std::optional<Device> device = {};            ///< of the tracker; by default one thread
};

/// A scene's frame as trackers see it. What is rendered is the whitened frame: a scene's noise is
/// known, and its unit is sigma.
Scan whitened_scan(const Scene& scene, std::uint64_t seed, int frame);

/// Scored at a cut-off of 5 px and order 2, P-PHD's accuracy of initiation. Throws
/// ConfigError for a setup that does not exist.
SceneRun run_scene(const Scene& scene, const TrackerSetup& setup, std::uint64_t seed,
                   const SceneRunOptions& options = {});

}  // namespace glint
