// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/experiments/experiment.hpp"

namespace glint {

// P-PHD section 5 for the conditions and bands of a right implementation. OSPA and GOSPA have a
// cut-off of 5 px and order 2.

/// Section 5.1, one target at 12, 10 and 8 dB and none: OSPA while the target is present and over
/// all frames, GOSPA, cardinality error, RMSE, share of frames detected, expected number of
/// targets. Every state is scored, tracks or not.
ExperimentResult run_phd_5_1(const ExperimentOptions& options, Workers& workers);

/// Section 5.2, three targets that manoeuvre: mm-phd beside itself with one CV model, figures 4 and
/// 5.
ExperimentResult run_phd_5_2(const ExperimentOptions& options, Workers& workers);

/// Section 5.3, every system on the same frames: tables 2 to 4, figures 7 and 8.
ExperimentResult run_phd_5_3(const ExperimentOptions& options, Workers& workers);

/// One dim target on a course of its own in each run, at 12, 6 and 3 dB, and noise alone: share of
/// its frames with a confirmed point within 3 px, delay, false tracks. Not of a paper.
ExperimentResult run_dim_target(const ExperimentOptions& options, Workers& workers);

/// What trackers state about themselves, at 3 and 6 dB in 64x64 and 256x256 pixels: covariances
/// (NEES) and existence probabilities (Brier's score over the base rate's). Not of a paper.
ExperimentResult run_consistency(const ExperimentOptions& options, Workers& workers);

/// Two hundred targets in one frame: share of their points with a confirmed point within 3 px.
/// Not of a paper.
ExperimentResult run_dim_field(const ExperimentOptions& options, Workers& workers);

/// The same target at 3 dB with a cue within 3 px in its first frame, and a cue upon noise alone:
/// share of runs that hold the target, which is to have a confirmed point within 3 px of it in at
/// least half of its frames and in most of the last five; frames with a confirmed
/// track on noise. Not of a paper.
ExperimentResult run_cue(const ExperimentOptions& options, Workers& workers);

}  // namespace glint
