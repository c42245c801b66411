// SPDX-License-Identifier: Apache-2.0
#include "glint/experiments/figures.hpp"

#include <cmath>

#include "glint/experiments/experiment.hpp"

namespace glint {
namespace {

/// The score of a target, or nothing if it never was in the scored frames.
const TruthScore* score_of(const SceneRun& run, Record record, std::size_t target) {
  const auto& truths = (run.*record).scores.truths;
  const auto found = truths.find(static_cast<std::int64_t>(target));
  return found == truths.end() ? nullptr : &found->second;
}

}  // namespace

double ospa_while_present(const SceneRun& run, Record record) {
  std::vector<double> distances;
  for (std::size_t k = 0; k < run.targets.size(); ++k) {
    if (run.targets[k] > 0) distances.push_back((run.*record).scores.ospa[k].distance);
  }
  return summarise(distances).mean;
}

double ospa_while_empty(const SceneRun& run, Record record) {
  std::vector<double> distances;
  int empty_for = 2;
  for (std::size_t k = 0; k < run.targets.size(); ++k) {
    empty_for = run.targets[k] > 0 ? 0 : empty_for + 1;
    if (empty_for > 2) distances.push_back((run.*record).scores.ospa[k].distance);
  }
  return summarise(distances).mean;
}

double rmse(const SceneRun& run, Record record) {
  std::vector<double> squares;
  for (const TargetRecord& target : (run.*record).targets) {
    for (const double error : target.error) squares.push_back(error * error);
  }
  return std::sqrt(summarise(squares).mean);
}

double detected_targets(const SceneRun& run, Record record) {
  return 100 * (run.*record).scores.track_detection_probability;
}

double target_detected(const SceneRun& run, Record record, std::size_t target) {
  const TruthScore* score = score_of(run, record, target);
  return score == nullptr ? kUndefined : score->detected ? 100 : 0;
}

double false_tracks_in_100(const SceneRun& run, Record record) {
  return 100.0 * (run.*record).scores.false_tracks;
}

double confirmed_at(const SceneRun& run, std::size_t target) {
  const TruthScore* score = score_of(run, &SceneRun::online, target);
  return score == nullptr ? kUndefined
                          : static_cast<double>(score->first + 1) + score->detect_delay;
}

double halted_at(const SceneRun& run, std::size_t target) {
  return run.online.targets[target].halted + 1;
}

}  // namespace glint
