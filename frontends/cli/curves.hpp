// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "glint/experiments/experiment.hpp"
#include "glint/frontends/video/plot.hpp"

namespace glint::cli {

/// Writes an experiment's curves as CSV: frame, condition, level, and one column a metric, empty
/// where undefined. Throws UsageError if the file cannot be written.
void write_curves(const std::string& path, const ExperimentResult& result);

/// What is drawn of them: a row a metric, in it a panel for each level that has such curves.
/// Expected numbers of targets have a logarithmic axis: from noise to the literal readings lie
/// three decades.
std::vector<PlotRow> plot_of(const ExperimentResult& result);

/// Draws that. Throws std::runtime_error if the file cannot be
/// written; does nothing without OpenCV.
void plot_curves(const std::string& path, const ExperimentResult& result);

}  // namespace glint::cli
