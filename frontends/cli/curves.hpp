// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "glint/engine/experiments/experiment.hpp"

namespace glint::cli {

/// Writes an experiment's curves as CSV: frame, condition, level, and one column a metric, empty
/// where undefined. Throws UsageError if the file cannot be written.
void write_curves(const std::string& path, const ExperimentResult& result);

/// Draws them: one panel a metric and level. Throws std::runtime_error if the file cannot be
/// written; does nothing without OpenCV.
void plot_curves(const std::string& path, const ExperimentResult& result);

}  // namespace glint::cli
