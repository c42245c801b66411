// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <span>

#include "glint/experiments/scene_run.hpp"

namespace glint {

// Figures of one run; `record` is &SceneRun::online or &SceneRun::revised. NaN where undefined.
using Record = SceneScore SceneRun::*;

/// Mean OSPA over the frames with a target [px].
double ospa_while_present(const SceneRun& run, Record record);
/// Mean OSPA over the frames without a target, but for the two after a target has gone: that many
/// misses halt a track [px].
double ospa_while_empty(const SceneRun& run, Record record);
/// Root of the mean square error over the points of all targets [px].
double rmse(const SceneRun& run, Record record);
/// Share of the targets that a track counts for [%].
double detected_targets(const SceneRun& run, Record record);
double target_detected(const SceneRun& run, Record record, std::size_t target);
/// To be averaged: tracks that count for no target in a hundred runs.
double false_tracks_in_100(const SceneRun& run, Record record);
/// Frame, counted from 1, when a track of the target is first confirmed.
double confirmed_at(const SceneRun& run, std::size_t target);
/// Frame, counted from 1, when the target's last track ends; NaN if it lasts to the end.
double halted_at(const SceneRun& run, std::size_t target);

}  // namespace glint
