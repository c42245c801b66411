// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "glint/bench/bench.hpp"

namespace glint::bench {

/// What each way into the engine costs: the time of a 640x512 frame pushed in C++, in C, in Python,
/// through a pipe and through GStreamer, beside the same trackers fed by the plain pipeline. Ways
/// that this machine lacks are named on standard error.
std::vector<Result> bench_embed(const Options& options);

}  // namespace glint::bench
