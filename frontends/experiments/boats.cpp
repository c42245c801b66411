// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "glint/experiments/boat_tracker.hpp"
#include "glint/experiments/monte_carlo.hpp"
#include "glint/frontends/experiments/boat_run.hpp"
#include "glint/frontends/experiments/recorded.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint {
namespace {

constexpr double kEverywhere = std::numeric_limits<double>::infinity();

std::string file_of(const std::string& data, int scenario, const char* what) {
  const std::string name = "scenario" + std::to_string(scenario) + '_' + what + ".json";
  std::string file = (std::filesystem::path(data) / "autoferry" / name).string();
  if (std::filesystem::exists(file)) return file;
  throw UsageError(file + ": is not there; give --data the folder that docs/boats.md describes");
}

BoatRecord read_scenario(const std::string& data, int scenario, BoatSensor sensor) {
  if (data.empty()) {
    throw UsageError("needs --data FOLDER; docs/boats.md says what it must hold");
  }
  const std::string detections = file_of(data, scenario, "detections");
  return read_autoferry(detections, file_of(data, scenario, "groundTruth"), sensor);
}

constexpr JpdaReading kSingle{"imm-jpda", 1, WindowReading::best};
constexpr JpdaReading kRestart{"imm-mscan-jpda, reading A", 2, WindowReading::restart};
constexpr JpdaReading kBest{"imm-mscan-jpda", 2, WindowReading::best};

ImmJpdaConfig started_from_truth(ImmJpdaConfig config) {
  keep_to_known(config);
  return config;
}

ImmJpdaConfig started_by_itself(ImmJpdaConfig config, int misses) {
  config.life.confirm_hits = 3, config.life.confirm_window = 4;
  config.life.confirm_existence = config.life.halt_existence = 0;
  config.life.halt_misses = misses;
  return config;
}

struct Scenario {
  int number;
  Band radar;                            // OSPA [m] from known starts
  double lidar;                          // the same, most
  std::array<double, 2> least_coverage;  // by boat
};
const std::array kScenarios{
    Scenario{2, {6.5, 7.3}, 4.3, {.95, .95}}, Scenario{3, {14.5, 15.1}, 3.7, {.70, .95}},
    Scenario{5, {10.1, 10.7}, 3.2, {.95, .95}}, Scenario{16, {4.7, 5.7}, 4.0, {.95, .87}}};

// Lost by every tracker: its echo merges with the shore.
constexpr int kLostScenario = 3, kLostBoat = 1;

void add_known_rows(const std::string& name, const BoatScore& score, const Band& ospa, bool whole,
                    ExperimentResult& result) {
  result.rows.push_back(value_row(name, "OSPA [m]", {score.scores.mean_ospa.distance}, ospa));
  result.rows.push_back(value_row(name, "GOSPA [m]", {score.scores.mean_gospa.distance}));
  const std::optional<Band> none = whole ? std::optional(Band{{}, 0}) : std::nullopt;
  result.rows.push_back(value_row(name, "boats lost", {double(score.lost)}, none));
  result.rows.push_back(value_row(name, "boats swapped", {double(score.swapped)}, Band{{}, 0}));
}

/// Beside the same as positions.
void add_polar_rows(const std::string& name, const BoatScore& positions, const BoatScore& score,
                    ExperimentResult& result) {
  const double ospa = score.scores.mean_ospa.distance;
  result.rows.push_back(value_row(name, "OSPA [m]", {ospa}));
  result.rows.push_back(value_row(name, "beyond that of positions [m]",
                                  {ospa - positions.scores.mean_ospa.distance}, Band{-.4, .4}));
  result.rows.push_back(value_row(name, "boats lost", {double(score.lost)}));
  result.rows.push_back(value_row(name, "boats swapped", {double(score.swapped)}, Band{{}, 0}));
}

// A boat's echo lies this near its truth [m]: that of boat 2 of scenario 2 begins 22 to 27 m off.
constexpr double kEcho = 30;

/// `logic` is that of the tracker; no track may be confirmed later than the echoes allow.
void add_own_rows(const std::string& name, const BoatRecord& record, const HitLogic& logic,
                  const BoatScore& score, const Scenario& scenario, ExperimentResult& result) {
  for (const auto& [id, coverage] : score.coverage) {
    const std::string boat = "boat " + std::to_string(id) + ' ';
    const Band least{scenario.least_coverage[static_cast<std::size_t>(id - 1)], {}};
    const bool lost = scenario.number == kLostScenario && id == kLostBoat;
    result.rows.push_back(value_row(name, boat + "coverage", {coverage.any}, least));
    result.rows.push_back(value_row(name, boat + "by one track", {coverage.one},
                                    lost ? std::nullopt : std::optional(least)));
    const double echoes = confirmable_at(record, id, logic, kEcho);
    const auto confirmed = score.confirmed.find(id);
    result.rows.push_back(
        value_row(name, boat + "confirmed at scan",
                  {confirmed == score.confirmed.end() ? kUndefined : confirmed->second},
                  std::isnan(echoes) ? std::nullopt : std::optional(Band{{}, echoes})));
  }
  result.rows.push_back(value_row(name, "false tracks", {double(score.scores.false_tracks)}));
}

constexpr std::array kMethods{kSingle, kRestart, kBest};

/// `runs`: the scores of every run, by method, on the same seeds.
void add_stress_rows(int scenario, std::span<const std::vector<BoatScore>> runs,
                     ExperimentResult& result) {
  const auto column = [&](std::size_t method, const auto& value) {
    std::vector<double> values;
    for (const BoatScore& score : runs[method]) values.push_back(value(score));
    return values;
  };
  const auto ospa = [](const BoatScore& s) { return s.scores.mean_ospa.distance; };
  const auto broken = [](const BoatScore& s) { return 50.0 * (s.lost + s.swapped); };
  for (std::size_t method = 0; method < runs.size(); ++method) {
    const std::string name = "scenario " + std::to_string(scenario) + ", " + kMethods[method].name;
    const std::vector<double> ours = column(method, ospa);
    result.rows.push_back(value_row(name, "OSPA [m]", ours));
    const bool best = method + 1 == runs.size();
    result.rows.push_back(value_row(name, "lost or swapped [%]", column(method, broken),
                                    best ? std::optional(Band{{}, 1.5}) : std::nullopt));
    if (method == 0) continue;
    std::vector<double> gains = column(0, ospa);
    for (std::size_t r = 0; r < gains.size(); ++r) gains[r] -= ours[r];
    const Summary gain = summarise(gains);
    const double error = gain.spread / std::sqrt(static_cast<double>(gains.size()));
    result.rows.push_back(value_row(name, "below imm-jpda's [m]", gains));
    result.rows.push_back(value_row(name, "the same in errors", {gain.mean / error},
                                    scenario == 5 ? std::nullopt : std::optional(Band{2, {}})));
  }
}

}  // namespace

ExperimentResult run_jpda_boats(const ExperimentOptions& options, Workers&) {
  ExperimentResult result;
  for (const Scenario& s : kScenarios) {
    const BoatRecord radar = read_scenario(options.data, s.number, BoatSensor::radar);
    BoatTrial near;
    near.reach = 100;
    const BoatRecord lidar =
        changed(read_scenario(options.data, s.number, BoatSensor::lidar), near);
    for (const JpdaReading& method : kMethods) {
      const std::string title = "scenario " + std::to_string(s.number) + ", " + method.name;
      const ImmJpdaConfig config = boat_tracker(method);
      const BoatScore known = follow_boats(radar, started_from_truth(config), kEverywhere);
      add_known_rows(title + ", radar", known, s.radar, s.number != kLostScenario, result);
      ImmJpdaConfig polar = started_from_truth(config);
      polar.measurement = MeasuredQuantity::range_azimuth, polar.range_sd = 4.5,
      polar.azimuth_sd = .03;
      add_polar_rows(title + ", radar as range and azimuth", known,
                     follow_boats(radar, polar, kEverywhere), result);
      const ImmJpdaConfig own = started_by_itself(config, 5);
      add_own_rows(title + ", radar, own start", radar, own.life,
                   follow_boats(radar, own, kEverywhere), s, result);
      add_known_rows(title + ", lidar", follow_boats(lidar, started_from_truth(config), near.reach),
                     Band{{}, s.lidar}, true, result);
    }
  }
  return result;
}

ExperimentResult run_jpda_boats_stress(const ExperimentOptions& options, Workers& workers) {
  constexpr std::array kNumbers{2, 5, 16};
  std::vector<BoatRecord> records;
  records.reserve(kNumbers.size());
  for (const int n : kNumbers) {
    records.push_back(read_scenario(options.data, n, BoatSensor::radar));
  }
  const auto runs = run_cases(
      kNumbers.size() * kMethods.size(), options, workers, [&](std::size_t which, std::size_t run) {
        BoatTrial trial;
        trial.keep = 0.7, trial.clutter = 3e-4, trial.seed = options.seed + run;
        ImmJpdaConfig config = started_from_truth(boat_tracker(kMethods[which % kMethods.size()]));
        config.clutter_density = 3e-4;
        config.detection = 0.63;
        return follow_boats(changed(records[which / kMethods.size()], trial), config, kEverywhere);
      });
  ExperimentResult result;
  for (std::size_t i = 0; i < kNumbers.size(); ++i) {
    add_stress_rows(kNumbers[i], std::span(runs).subspan(i * kMethods.size(), kMethods.size()),
                    result);
  }
  return result;
}

}  // namespace glint
