// SPDX-License-Identifier: Apache-2.0
#include "glint/experiments/condition.hpp"

#include <cmath>
#include <utility>

#include "glint/experiments/monte_carlo.hpp"

namespace glint {
namespace {

std::vector<double> values_of(const Figure& figure, const Runs& runs) {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const SceneRun& run : runs) values.push_back(figure.of(run));
  return values;
}

}  // namespace

std::vector<Runs> run_conditions(std::span<const Condition> conditions,
                                 const ExperimentOptions& options, Workers& workers,
                                 ExperimentResult& result) {
  std::vector<Runs> all =
      run_cases(conditions.size(), options, workers, [&](std::size_t which, std::size_t run) {
        const Condition& condition = conditions[which];
        SceneRunOptions of_run = condition.options;
        of_run.device = options.device;
        return run_scene(condition.scene, condition.setup, options.seed + run, of_run);
      });
  for (std::size_t which = 0; which < conditions.size(); ++which) {
    const Condition& condition = conditions[which];
    for (const Figure& figure : condition.figures) {
      result.rows.push_back(value_row(condition.title(), figure.metric,
                                      values_of(figure, all[which]), figure.band, figure.paper));
    }
  }
  return all;
}

ExperimentRow gain_row(std::string name, const Figure& figure, const Runs& runs, const Runs& than) {
  std::vector<double> gains = values_of(figure, than);
  const std::vector<double> ours = values_of(figure, runs);
  for (std::size_t r = 0; r < gains.size(); ++r) gains[r] -= ours[r];
  return value_row(std::move(name), figure.metric, gains, figure.band, figure.paper);
}

Curve mean_curve(std::string level, std::string condition, std::string metric, const Runs& runs,
                 const std::function<double(const SceneRun&, std::size_t frame)>& value) {
  Curve curve{std::move(level), std::move(condition), std::move(metric), {}, {}};
  for (std::size_t k = 0; k < runs.front().targets.size(); ++k) {
    std::vector<double> values;
    for (const SceneRun& run : runs) values.push_back(value(run, k));
    curve.frame.push_back(static_cast<double>(k + 1));
    curve.value.push_back(summarise(values).mean);
  }
  return curve;
}

Curve rmse_curve(std::string level, std::string condition, const Runs& runs,
                 SceneScore SceneRun::*record, std::size_t target) {
  Curve curve = mean_curve(std::move(level), std::move(condition), "rmse", runs,
                           [&](const SceneRun& run, std::size_t k) {
                             const double error = (run.*record).targets[target].error[k];
                             return error * error;
                           });
  for (double& value : curve.value) value = std::sqrt(value);
  return curve;
}

}  // namespace glint
