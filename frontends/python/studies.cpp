// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/python/studies.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "glint/engine/metrics/consistency.hpp"
#include "glint/engine/scenario/scenario.hpp"
#include "glint/experiments/experiment.hpp"

namespace glint::python {
namespace {

using py::literals::operator""_a;

/// Fills `to` with the frames, one after the other, and `times`.
void render_all(SceneSource& source, float* to, std::vector<double>& times) {
  while (const auto frame = source.next()) {
    const RawPixels& pixels = frame->pixels;
    for (int y = 0; y < pixels.height; ++y) {
      to = std::copy_n(std::get<const float*>(pixels.data) + y * pixels.pitch, pixels.width, to);
    }
    times.push_back(frame->time);
  }
}

py::object number(double value) {
  return std::isnan(value) ? py::object(py::none()) : py::object(py::float_(value));
}

template <class Part>
py::list distances(const std::vector<Part>& parts) {
  py::list list;
  for (const Part& part : parts) list.append(number(part.distance));
  return list;
}

py::dict per_truth(const Evaluation& scores, double TruthScore::*value) {
  py::dict dict;
  for (const auto& [id, score] : scores.truths) dict[py::int_(id)] = number(score.*value);
  return dict;
}

/// A mean over no frames is undefined.
py::object mean(const Evaluation& scores, double value) {
  return scores.ospa.empty() ? py::object(py::none()) : number(value);
}

/// None for a mean over no points.
py::object nees(const PointSum& of) {
  if (of.points == 0) return py::none();
  return py::dict("mean"_a = of.mean(), "points"_a = of.points);
}

py::dict scores_dict(const Evaluation& e, const Consistency& c) {
  return py::dict(
      "ospa"_a = py::dict("mean"_a = mean(e, e.mean_ospa.distance),
                          "localisation"_a = mean(e, e.mean_ospa.localisation),
                          "cardinality"_a = mean(e, e.mean_ospa.cardinality),
                          "per_frame"_a = distances(e.ospa)),
      "gospa"_a = py::dict("mean"_a = mean(e, e.mean_gospa.distance),
                           "localisation"_a = mean(e, e.mean_gospa.localisation),
                           "missed"_a = mean(e, e.mean_gospa.missed),
                           "false"_a = mean(e, e.mean_gospa.false_alarms),
                           "per_frame"_a = distances(e.gospa)),
      "rmse"_a = per_truth(e, &TruthScore::rmse),
      "tracks"_a =
          py::dict("truth"_a = e.truths.size(), "detected"_a = e.detected_truths,
                   "false"_a = e.false_tracks, "pd_track"_a = number(e.track_detection_probability),
                   "identities_per_truth"_a = number(e.identities_per_truth)),
      "detect_delay"_a = per_truth(e, &TruthScore::detect_delay),
      "halt_delay"_a = per_truth(e, &TruthScore::halt_delay),
      "points"_a = py::dict("detected"_a = number(e.detected_points),
                            "false_per_frame"_a = number(e.false_points_per_frame)),
      "position_nees"_a = nees(c.position_nees), "state_nees"_a = nees(c.state_nees),
      "brier"_a = number(c.brier()), "brier_of_base_rate"_a = number(c.brier_of_base_rate()));
}

py::dict row_dict(const ExperimentRow& row) {
  py::object band = py::none();
  if (row.band) band = py::make_tuple(row.band->low, row.band->high);
  return py::dict("name"_a = row.name, "metric"_a = row.metric, "ours"_a = number(row.ours),
                  "spread"_a = number(row.spread), "paper"_a = row.paper, "band"_a = band,
                  "inside"_a = row.inside());
}

py::dict curve_dict(const Curve& curve) {
  return py::dict("level"_a = curve.level, "condition"_a = curve.condition,
                  "metric"_a = curve.metric, "frame"_a = array_of(curve.frame),
                  "value"_a = array_of(curve.value));
}

}  // namespace

py::tuple simulate(const std::string& name, std::uint64_t seed, const Values& settings) {
  const Scene scene = find_scene(name).make(scene_section(name, settings));
  py::array_t<float> frames({scene.frames, scene.height, scene.width});
  float* const first = frames.mutable_data();
  std::vector<double> times;
  std::vector<TruthPoint> truth;
  {
    const py::gil_scoped_release release;
    truth = truth_of(scene);
    SceneSource source(scene, seed);
    render_all(source, first, times);
  }
  return py::make_tuple(frames, array_of(times), truth_array(truth));
}

py::dict evaluate_rows(const TrackArray& tracks, const TruthArray& truth,
                       const EvaluationOptions& options) {
  const auto points = track_points(tracks);
  const auto truths = truth_points(truth);
  Evaluation scores;
  Consistency stated;
  {
    const py::gil_scoped_release release;
    scores = evaluate(truths, points, options);
    stated = consistency(truths, points, options.cutoff, options.frames);
  }
  return scores_dict(scores, stated);
}

py::dict run_named_experiment(const std::string& name, int runs, std::uint64_t seed, int threads) {
  const ExperimentEntry& entry = find_experiment(name);
  ExperimentOptions options;
  options.runs = runs, options.seed = seed;
  ExperimentResult result;
  {
    const py::gil_scoped_release release;
    Workers workers(threads);
    result = run_experiment(entry, options, workers);
  }
  py::list rows, curves;
  for (const ExperimentRow& row : result.rows) rows.append(row_dict(row));
  for (const Curve& curve : result.curves) curves.append(curve_dict(curve));
  return py::dict("experiment"_a = result.name, "runs"_a = result.runs, "seed"_a = result.seed,
                  "rows"_a = rows, "curves"_a = curves);
}

}  // namespace glint::python
