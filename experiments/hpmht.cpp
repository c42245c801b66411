// SPDX-License-Identifier: Apache-2.0
#include "glint/experiments/hpmht.hpp"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "glint/experiments/aircraft_run.hpp"
#include "glint/experiments/monte_carlo.hpp"

namespace glint {
namespace {

/// What the paper prints of a tracker in a scenario.
struct Printed {
  double hit, deviation;  // [%], [px]
};

struct Case {
  std::string name;
  int scenario;
  std::function<AircraftRun(std::uint64_t seed, const Device& device)> run;
  std::optional<Printed> paper{};
  std::optional<Band> hit_band{}, deviation_band{};
};

/// Section 4: batches of 5 scans, R = 16 I and pi = .5 at the start, Q of (22).
HPmhtConfig h_pmht() {
  HPmhtConfig config;
  config.intensity = CellIntensity::rpim;
  config.batch = 5, config.iterations = 20;
  config.estimate_extent = true, config.extent = 16;
  config.process_noise = 1, config.velocity_variance = 1;
  config.sensor_area = 100;
  config.initiate = false;
  config.halt_count = 0;
  return config;
}

/// Units whose mean exceeds `scale` times the threshold.
ImmPdaAiConfig imm_pda_ai(UnitThreshold threshold, double scale) {
  ImmPdaAiConfig config;
  config.points = PointOrigin::units, config.threshold = threshold, config.threshold_scale = scale;
  config.initiate = false;
  config.life.halt_misses = 1000;
  return config;
}

template <class Config>
std::function<AircraftRun(std::uint64_t, const Device&)> runner(
    int scenario, Config config, AircraftStart start = AircraftStart::two_scans) {
  return [=](std::uint64_t seed, const Device& device) {
    return run_aircraft(scenario, config, seed, start, device);
  };
}

std::vector<std::vector<AircraftRun>> run_all(const std::vector<Case>& cases,
                                              const ExperimentOptions& options, Workers& workers,
                                              ExperimentResult& result) {
  auto runs = run_cases(cases.size(), options, workers, [&](std::size_t which, std::size_t run) {
    return cases[which].run(options.seed + run, options.device ? *options.device : Device::tbb(1));
  });
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    std::optional<double> hit, deviation;
    if (c.paper) hit = c.paper->hit, deviation = c.paper->deviation;
    result.rows.push_back(value_row(c.name, "hit on target [%]", column(runs[i], &AircraftRun::hit),
                                    c.hit_band, hit));
    result.rows.push_back(value_row(c.name, "deviation [px]",
                                    column(runs[i], &AircraftRun::deviation), c.deviation_band,
                                    deviation));
  }
  return runs;
}

/// How far a tracker's deviation lies below another's, run by run; it must.
ExperimentRow gain(const std::string& name, const char* metric,
                   const std::vector<AircraftRun>& others, const std::vector<AircraftRun>& ours,
                   const std::optional<double>& paper) {
  std::vector<double> gains = column(others, &AircraftRun::deviation);
  for (std::size_t r = 0; r < gains.size(); ++r) gains[r] -= ours[r].deviation;
  return value_row(name, metric, gains, Band{0, {}}, paper);
}

std::string title(const char* tracker, int scenario) {
  return std::string(tracker) + ", scenario " + std::to_string(scenario);
}

}  // namespace

ExperimentResult run_hpmht_table_2(const ExperimentOptions& options, Workers& workers) {
  constexpr std::array<Printed, 7> kHPmht{
      {{100, 3.4}, {100, 3.9}, {100, 3.52}, {100, 2.3}, {85, 3.6}, {90, 3}, {100, 2.95}}};
  constexpr std::array<Printed, 7> kImmPda{
      {{55, 8.98}, {100, 7.9}, {60, 10.15}, {55, 8.5}, {10, 8.7}, {30, 5.61}, {100, 7.2}}};
  constexpr std::array kMostDeviation{1.1, 1.6, 2.0, 3.0, 1.2, 0.6, 1.5};
  constexpr std::size_t kTrackers = 3;  // a scenario
  std::vector<Case> cases;
  for (int s = 1; s <= 7; ++s) {
    const auto i = static_cast<std::size_t>(s - 1);
    cases.push_back({title("h-pmht", s), s, runner(s, h_pmht()), kHPmht[i], Band{95, {}},
                     Band{{}, kMostDeviation[i]}});
    cases.push_back({title("imm-pda-ai", s),
                     s,
                     runner(s, imm_pda_ai(UnitThreshold::mean, 1.1)),
                     kImmPda[i],
                     {},
                     {}});
    // The stronger opponent: what a unit's amplitude says of clutter and targets misleads here.
    ImmPdaAiConfig blind = imm_pda_ai(UnitThreshold::mean, 1.1);
    blind.amplitude = AmplitudeModel::none;
    cases.push_back({title("imm-pda-ai, amplitude = none", s), s, runner(s, blind)});
  }
  ExperimentResult result;
  const auto runs = run_all(cases, options, workers, result);
  for (std::size_t i = 0; i < cases.size(); i += kTrackers) {
    const std::size_t s = i / kTrackers;
    result.rows.push_back(gain(cases[i].name, "deviation below imm-pda-ai's [px]", runs[i + 1],
                               runs[i], kImmPda[s].deviation - kHPmht[s].deviation));
    result.rows.push_back(
        gain(cases[i].name, "below that with amplitude = none [px]", runs[i + 2], runs[i], {}));
  }
  return result;
}

ExperimentResult run_hpmht_table_3(const ExperimentOptions& options, Workers& workers) {
  struct Line {
    int scenario;
    Printed h_pmht_low, imm_pda_low, h_pmht_high, imm_pda_high;
  };
  constexpr std::array<Line, 4> kLines{{{4, {15, 31.9}, {55, 9.5}, {100, 2.15}, {55, 8.7}},
                                        {6, {90, 3.1}, {30, 5.47}, {95, 3}, {20, 5.8}},
                                        {7, {100, 3.8}, {100, 7.2}, {100, 2.5}, {100, 7.2}},
                                        {3, {100, 3.7}, {60, 10.2}, {100, 3.5}, {60, 9.9}}}};
  HPmhtConfig keep = h_pmht();
  keep.threshold = CellThreshold::keep;  // m1
  keep.sensor_area = 1e12;               // the whole frame, as printed
  std::vector<Case> cases;
  for (const Line& line : kLines) {
    for (const double scale : {0.9, 1.1}) {
      keep.threshold_scale = scale;
      const bool low = scale < 1;
      const int s = line.scenario;
      const std::string at = low ? " at .9 I_Th" : " at 1.1 I_Th";
      cases.push_back(
          {title("h-pmht", s) + at, s, runner(s, keep), low ? line.h_pmht_low : line.h_pmht_high});
      // "21 scans, one for initialization" tells nothing of the velocity.
      cases.push_back({title("h-pmht", s) + at + ", at rest first", s,
                       runner(s, keep, AircraftStart::one_scan),
                       low ? line.h_pmht_low : line.h_pmht_high});
      cases.push_back({title("imm-pda-ai", s) + at, s,
                       runner(s, imm_pda_ai(UnitThreshold::displayed, scale)),
                       low ? line.imm_pda_low : line.imm_pda_high});
    }
  }
  cases.front().hit_band =
      Band{{}, 25};  // clutter above a low threshold takes a dim target's place
  ExperimentResult result;
  run_all(cases, options, workers, result);
  return result;
}

}  // namespace glint
