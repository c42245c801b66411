// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "glint/engine/metrics/consistency.hpp"
#include "glint/engine/metrics/evaluation.hpp"
#include "glint/frontends/cli/commands.hpp"
#include "glint/frontends/files/tables.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Request {
  std::string truth, tracks, baseline;
  EvaluationOptions options;
  std::optional<double> false_points;  // a frame
  bool json = false;
};

struct Scores {
  Evaluation evaluation;
  Consistency consistency;
};

struct Report {
  std::optional<Scores> scores;
  std::optional<Baseline> baseline;
};

Json number(double value) { return std::isnan(value) ? Json() : Json(value); }

template <class Part>
Json per_frame(const std::vector<Part>& parts) {
  Json list = Json::array();
  for (const Part& part : parts) list.push_back(number(part.distance));
  return list;
}

Json per_truth(const Evaluation& e, double TruthScore::*value) {
  Json list = Json::object();
  for (const auto& [id, score] : e.truths) list[std::to_string(id)] = number(score.*value);
  return list;
}

/// Null for a mean over no points.
Json nees(const PointSum& of) {
  return of.points == 0 ? Json() : Json{{"mean", of.mean()}, {"points", of.points}};
}

/// A mean over no frames is undefined.
Json mean(const Evaluation& e, double value) { return e.ospa.empty() ? Json() : Json(value); }

Json json_of(const Scores& scores) {
  const Evaluation& e = scores.evaluation;
  const Consistency& c = scores.consistency;
  return {{"ospa",
           {{"mean", mean(e, e.mean_ospa.distance)},
            {"localisation", mean(e, e.mean_ospa.localisation)},
            {"cardinality", mean(e, e.mean_ospa.cardinality)},
            {"per_frame", per_frame(e.ospa)}}},
          {"gospa",
           {{"mean", mean(e, e.mean_gospa.distance)},
            {"localisation", mean(e, e.mean_gospa.localisation)},
            {"missed", mean(e, e.mean_gospa.missed)},
            {"false", mean(e, e.mean_gospa.false_alarms)},
            {"per_frame", per_frame(e.gospa)}}},
          {"rmse", per_truth(e, &TruthScore::rmse)},
          {"tracks",
           {{"truth", e.truths.size()},
            {"detected", e.detected_truths},
            {"false", e.false_tracks},
            {"pd_track", number(e.track_detection_probability)},
            {"identities_per_truth", number(e.identities_per_truth)}}},
          {"detect_delay", per_truth(e, &TruthScore::detect_delay)},
          {"halt_delay", per_truth(e, &TruthScore::halt_delay)},
          {"points",
           {{"detected", number(e.detected_points)},
            {"false_per_frame", number(e.false_points_per_frame)}}},
          {"position_nees", nees(c.position_nees)},
          {"state_nees", nees(c.state_nees)},
          {"brier", number(c.brier())},
          {"brier_of_base_rate", number(c.brier_of_base_rate())}};
}

void print_json(const Report& report) {
  Json all = report.scores ? json_of(*report.scores) : Json::object();
  if (report.baseline) {
    all["baseline"] = {{"threshold", number(report.baseline->threshold)},
                       {"detected", number(report.baseline->detected_points)},
                       {"false_per_frame", number(report.baseline->false_points_per_frame)}};
  }
  fmt::print("{}\n", all.dump());
}

std::string text(double value) { return std::isnan(value) ? "-" : fmt::format("{:.3f}", value); }

void print_truths(const Evaluation& e) {
  fmt::print("\n{:>8}{:>14}{:>11}{:>14}{:>12}{:>8}\n", "truth", "frames", "rmse px", "detect delay",
             "halt delay", "tracks");
  for (const auto& [id, t] : e.truths) {
    fmt::print("{:>8}{:>14}{:>11}{:>14}{:>12}{:>8}\n", id, fmt::format("{}..{}", t.first, t.last),
               text(t.rmse), text(t.detect_delay), text(t.halt_delay), t.identities);
  }
}

void print_scores(const Evaluation& e) {
  fmt::print("frames                     {}\n", e.ospa.size());
  fmt::print("OSPA [px]                  {}   (localisation {}, cardinality {})\n",
             text(e.mean_ospa.distance), text(e.mean_ospa.localisation),
             text(e.mean_ospa.cardinality));
  fmt::print("GOSPA [px]                 {}   (localisation {}, missed {}, false {})\n",
             text(e.mean_gospa.distance), text(e.mean_gospa.localisation),
             text(e.mean_gospa.missed), text(e.mean_gospa.false_alarms));
  fmt::print("truths detected            {} of {}\n", e.detected_truths, e.truths.size());
  fmt::print("tracks                     {}, {} false\n", e.tracks, e.false_tracks);
  fmt::print("identities per truth       {}\n", text(e.identities_per_truth));
  fmt::print("truth points detected      {}\n", text(e.detected_points));
  fmt::print("false points per frame     {}\n", text(e.false_points_per_frame));
}

void print_nees(const char* of, const PointSum& nees, int right) {
  if (nees.points == 0) return;
  fmt::print("NEES of {:<19}{} over {} points, {} if the covariances are right\n", of,
             text(nees.mean()), nees.points, right);
}

/// What the tracks do not state, or no truth can be set against, is left out.
void print_consistency(const Consistency& c) {
  print_nees("position", c.position_nees, 2);
  print_nees("state", c.state_nees, 4);
  if (c.existence_error.points == 0) return;
  fmt::print("Brier's score of existence {} over {} points, {} for their base rate\n",
             text(c.brier()), c.existence_error.points, text(c.brier_of_base_rate()));
}

void print_table(const Report& report) {
  if (report.scores) print_scores(report.scores->evaluation);
  if (report.baseline) {
    fmt::print(
        "single-frame detector      {} detected at {} false points per frame, threshold {}\n",
        text(report.baseline->detected_points), text(report.baseline->false_points_per_frame),
        text(report.baseline->threshold));
  }
  if (!report.scores) return;
  print_consistency(report.scores->consistency);
  print_truths(report.scores->evaluation);
}

/// Throws UsageError unless there is something to score.
void check(const Request& request) {
  if (request.tracks.empty() && request.baseline.empty()) {
    throw UsageError("nothing to score: give --tracks, or --baseline and --false-points");
  }
  if (request.baseline.empty() && request.false_points) {
    throw UsageError("--false-points is for a detector: give its points by --baseline");
  }
  if (request.tracks.empty() && !request.false_points) {
    throw UsageError("--baseline without --tracks needs --false-points");
  }
}

Scores scores_of(const std::vector<TruthPoint>& truth, const std::vector<TrackPoint>& tracks,
                 const EvaluationOptions& options) {
  return {evaluate(truth, tracks, options),
          consistency(truth, tracks, options.cutoff, options.frames)};
}

void run(Request request) {
  check(request);
  const std::vector<TruthPoint> truth = read_truth(request.truth);
  Report report;
  if (!request.tracks.empty()) {
    report.scores = scores_of(truth, read_tracks(request.tracks), request.options);
    request.options.frames = static_cast<std::int64_t>(report.scores->evaluation.ospa.size());
  }
  if (!request.baseline.empty()) {
    const double allowed = request.false_points ? *request.false_points
                                                : report.scores->evaluation.false_points_per_frame;
    report.baseline =
        detector_baseline(truth, read_points(request.baseline), allowed, request.options);
  }
  if (request.json) {
    print_json(report);
  } else {
    print_table(report);
  }
}

}  // namespace

void add_evaluate(Command& program) {
  Command command = program.subcommand("evaluate", "Score tracks, or points, against the truth");
  const auto request = std::make_shared<Request>();
  command.option("--truth", request->truth, "Truth table (CSV)").required();
  command.option("--tracks", request->tracks, "Track table (CSV)");
  command.option("--cutoff", request->options.cutoff, "Farther than this is a miss [px]")
      .in_range(1e-6, 1e6)
      .with_default();
  command.option("--order", request->options.order, "Order of OSPA and GOSPA")
      .in_range(1.0, 100.0)
      .with_default();
  command
      .option("--frames", request->options.frames,
              "Frames 0 to N-1 are scored; by default up to the last one in either table")
      .in_range(std::int64_t{0}, std::int64_t{10'000'000});
  command.option("--baseline", request->baseline,
                 "Points of a single-frame detector (CSV), scored at the threshold that gives "
                 "as many false points as the tracks have");
  command
      .option("--false-points", request->false_points,
              "At most so many false points a frame for the baseline, in place of the tracks'")
      .in_range(0.0, 1e6);
  command.flag("--include-tentative", request->options.include_tentative,
               "Score tentative points too, but for those that state an existence below 1/2");
  command.flag("--json", request->json, "Print JSON instead of a table");
  command.footer(
      "Truth needs the columns frame, track_id, x, y (or frame0, linked_id, cx, cy), tracks the\n"
      "first four, points frame, x, y, amplitude. Delays are in frames.\n"
      "NEES is the squared error in units of the stated covariance, e' P^-1 e, of confirmed\n"
      "points with a truth within the cut-off: of the position if the tracks have var_x, cov_xy,\n"
      "var_y, and of the state (position and velocity) if they have all that glint track\n"
      "--covariance writes and the truth has vx, vy. Above 2 and 4 the covariances are too\n"
      "small, below too large. Brier's score is the mean squared error of existence against 1\n"
      "with a truth within the cut-off, else 0, of tentative points too; beside it that of\n"
      "stating of every point how many of them have a truth.\n"
      "Example:\n  glint evaluate --truth truth.csv --tracks tracks.csv --cutoff 8\n"
      "  glint evaluate --truth truth.csv --baseline points.csv --false-points 1");
  command.callback([request] { run(*request); });
}

}  // namespace glint::cli
