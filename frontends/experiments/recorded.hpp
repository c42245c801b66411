// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>

#include "glint/experiments/experiment.hpp"

namespace glint {

/// Experiments on recorded data, which the engine by itself cannot read; ExperimentOptions::data
/// names the folder. They throw UsageError for files that are not there.
std::span<const ExperimentEntry> recorded_experiments();

/// Trackers on real clips, with white noise added, beside the single-frame matched filter
/// (docs/real-video.md).
ExperimentResult run_real_video(const ExperimentOptions& options, Workers& workers);

/// imm-jpda and imm-mscan-jpda on two real boats (docs/boats.md): as they were seen, and with
/// points taken away and others added.
ExperimentResult run_jpda_boats(const ExperimentOptions& options, Workers& workers);
ExperimentResult run_jpda_boats_stress(const ExperimentOptions& options, Workers& workers);

}  // namespace glint
