// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "glint/engine/experiments/experiment.hpp"

namespace glint {

/// Mean and spread of one value a run.
inline ExperimentRow value_row(std::string name, std::string metric,
                               const std::vector<double>& values,
                               const std::optional<Band>& band = {}) {
  const Summary summary = summarise(values);
  ExperimentRow row;
  row.name = std::move(name), row.metric = std::move(metric);
  row.ours = summary.mean, row.spread = summary.spread, row.band = band;
  return row;
}

}  // namespace glint
