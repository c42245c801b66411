// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "glint/experiments/experiment.hpp"
#include "glint/experiments/scene_run.hpp"

namespace glint {

/// A figure of one run; its mean and spread over the runs make a row.
struct Figure {
  std::string metric;
  std::function<double(const SceneRun&)> of;  ///< NaN: this run does not count
  std::optional<double> paper{};
  std::optional<Band> band{};
};

/// What is run: a tracker on a scene; and what is wanted of it.
struct Condition {
  std::string name, level;  ///< level: "10 dB", or empty
  Scene scene;
  TrackerSetup setup;
  SceneRunOptions options;
  std::vector<Figure> figures;

  std::string title() const { return level.empty() ? name : name + ", " + level; }
};

using Runs = std::vector<SceneRun>;

/// Every condition on the same seeds, and a row for each of its figures; the runs by condition.
std::vector<Runs> run_conditions(std::span<const Condition> conditions,
                                 const ExperimentOptions& options, Workers& workers,
                                 ExperimentResult& result);

/// By how much `than` is above `runs`, seed by seed.
ExperimentRow gain_row(std::string name, const Figure& figure, const Runs& runs, const Runs& than);

/// The mean over runs of value(run, frame), frames counted from 1.
Curve mean_curve(std::string level, std::string condition, std::string metric, const Runs& runs,
                 const std::function<double(const SceneRun&, std::size_t frame)>& value);

/// The root of the mean square over runs of a target's error. P-PHD (38)
Curve rmse_curve(std::string level, std::string condition, const Runs& runs,
                 SceneScore SceneRun::*record, std::size_t target);

}  // namespace glint
