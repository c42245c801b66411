// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/experiments/phd.hpp"

#include <cmath>
#include <span>
#include <utility>

#include "glint/engine/experiments/monte_carlo.hpp"
#include "glint/engine/experiments/phd_conditions.hpp"
#include "glint/engine/metrics/evaluation.hpp"
#include "glint/engine/scenario/scenes.hpp"

namespace glint {
namespace {

/// One run, by frame; errors are NaN where nothing was said in reach of the target.
struct Run {
  Evaluation scores;
  std::vector<bool> present;
  std::vector<double> expected, error;  // targets; [px]
};

/// The frames when n has settled: the paper's 15 to 24.
constexpr std::size_t kLateBegin = 14, kLateEnd = 24;

Scene scene_of(const PhdCondition& condition, std::size_t level) {
  PhdScene config;
  config.snr = kPhdSnr[level];
  Scene scene = make_scene(config);
  if (!condition.has_target) scene.targets.clear();
  return scene;
}

double error_at(const Scene& scene, int frame, const std::vector<TrackPoint>& said,
                const EvaluationOptions& options) {
  std::vector<Position> truth, points;
  for (const TruthPoint& t : truth_at(scene, frame)) truth.push_back({t.x, t.y});
  for (const TrackPoint& p : said) {
    if (p.status != TrackStatus::halted) points.push_back({p.x, p.y});
  }
  const std::vector<Match> pairs = match(truth, points, options.cutoff, options.order);
  return pairs.empty() ? kUndefined : pairs.front().distance;
}

/// The noise is known here, so the frame as rendered is the whitened one.
Run run_once(const PhdCondition& condition, std::size_t level, std::uint64_t seed) {
  const Scene scene = scene_of(condition, level);
  EvaluationOptions options;
  options.include_tentative = true;
  options.frames = scene.frames;
  SmcPhd tracker(condition.settings(level), Device::tbb(1), seed);
  TrackLog log;
  Run run;
  for (int k = 0; k < scene.frames; ++k) {
    Scan scan;
    scan.frame = k;
    scan.time = k * scene.interval;
    scan.whitened = Frame(render(scene, seed, k));
    tracker.step(scan, log);
    run.expected.push_back(tracker.expected_targets());
    run.error.push_back(error_at(scene, k, log.at(k), options));
    run.present.push_back(!truth_at(scene, k).empty());
  }
  tracker.finish(log);
  run.scores = evaluate(truth_of(scene), log.online(), options);
  return run;
}

double mean_ospa_while_present(const Run& run) {
  std::vector<double> distances;
  for (std::size_t k = 0; k < run.present.size(); ++k) {
    if (run.present[k]) distances.push_back(run.scores.ospa[k].distance);
  }
  return summarise(distances).mean;
}

double rmse(const Run& run) {
  return run.scores.truths.empty() ? kUndefined : run.scores.truths.begin()->second.rmse;
}

double late_expected(const Run& run) {
  return summarise(std::span(run.expected).subspan(kLateBegin, kLateEnd - kLateBegin)).mean;
}

/// A figure of one run, and whether it needs a target.
struct Figure {
  const char* metric;
  double (*of)(const Run&);
  bool needs_target;
  PhdBands PhdCondition::*bands;
};

constexpr Figure kFigures[] = {
    {"OSPA while present [px]", mean_ospa_while_present, true, &PhdCondition::ospa},
    {"OSPA, all frames [px]", [](const Run& r) { return r.scores.mean_ospa.distance; }, false, {}},
    {"GOSPA, all frames [px]",
     [](const Run& r) { return r.scores.mean_gospa.distance; },
     false,
     {}},
    {"cardinality error", [](const Run& r) { return r.scores.mean_cardinality_error; }, false, {}},
    {"RMSE [px]", rmse, true, {}},
    {"detected", [](const Run& r) { return r.scores.detected_points; }, true, {}},
    {"n, frames 15-24", late_expected, false, &PhdCondition::expected},
};

std::string level_name(std::size_t level) { return std::to_string(kPhdSnr[level]) + " dB"; }

void add_rows(const PhdCondition& condition, std::size_t level, std::span<const Run> runs,
              ExperimentResult& result) {
  for (const Figure& figure : kFigures) {
    if (figure.needs_target && !condition.has_target) continue;
    std::vector<double> values;
    for (const Run& run : runs) values.push_back(figure.of(run));
    const Summary summary = summarise(values);
    ExperimentRow row;
    row.name = condition.name + ", " + level_name(level);
    row.metric = figure.metric;
    row.ours = summary.mean, row.spread = summary.spread;
    if (figure.bands) row.band = (condition.*figure.bands)[level];
    result.rows.push_back(std::move(row));
  }
}

/// OSPA and n are means over runs, RMSE is P-PHD (38) over the runs that see the target.
void add_curves(const PhdCondition& condition, std::size_t level, std::span<const Run> runs,
                ExperimentResult& result) {
  Curve ospa{level_name(level), condition.name, "ospa", {}, {}};
  Curve rmse{level_name(level), condition.name, "rmse", {}, {}};
  Curve expected{level_name(level), condition.name, "n", {}, {}};
  const auto mean = [&](const auto& value) {
    std::vector<double> values;
    for (const Run& run : runs) values.push_back(value(run));
    return summarise(values).mean;
  };
  for (std::size_t k = 0; k < runs.front().present.size(); ++k) {
    for (Curve* curve : {&ospa, &rmse, &expected}) {
      curve->frame.push_back(static_cast<double>(k + 1));  // as the paper counts
    }
    ospa.value.push_back(mean([k](const Run& r) { return r.scores.ospa[k].distance; }));
    rmse.value.push_back(std::sqrt(mean([k](const Run& r) { return r.error[k] * r.error[k]; })));
    expected.value.push_back(mean([k](const Run& r) { return r.expected[k]; }));
  }
  for (Curve* curve : {&ospa, &rmse, &expected}) result.curves.push_back(std::move(*curve));
}

}  // namespace

ExperimentResult run_phd_5_1(const ExperimentOptions& options, Workers& workers) {
  const std::vector<PhdCondition> conditions = phd_conditions();
  const std::size_t cases = conditions.size() * kPhdSnr.size();
  const auto runs = static_cast<std::size_t>(options.runs);
  // Runs outermost, so that threads share slow and fast conditions evenly.
  const auto by_run = run_jobs(cases * runs, workers, options.progress, [&](std::size_t job) {
    const std::size_t which = job % cases;
    return run_once(conditions[which / kPhdSnr.size()], which % kPhdSnr.size(),
                    options.seed + job / cases);
  });
  ExperimentResult result;
  for (std::size_t which = 0; which < cases; ++which) {
    std::vector<Run> of;
    for (std::size_t r = 0; r < runs; ++r) of.push_back(by_run[r * cases + which]);
    add_rows(conditions[which / kPhdSnr.size()], which % kPhdSnr.size(), of, result);
    add_curves(conditions[which / kPhdSnr.size()], which % kPhdSnr.size(), of, result);
  }
  return result;
}

}  // namespace glint
