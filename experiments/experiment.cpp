// SPDX-License-Identifier: Apache-2.0
#include "glint/experiments/experiment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "glint/engine/config.hpp"
#include "glint/experiments/hpmht.hpp"
#include "glint/experiments/jpda.hpp"
#include "glint/experiments/phd.hpp"
#include "glint/experiments/pmht.hpp"

namespace glint {
namespace {

constexpr std::array kExperiments{
    ExperimentEntry{"phd-5.1", "one dim target at 12, 10 and 8 dB: P-PHD section 5.1", 100,
                    run_phd_5_1, true},
    ExperimentEntry{"phd-5.2", "three targets that manoeuvre at 10 dB: P-PHD section 5.2", 100,
                    run_phd_5_2, true},
    ExperimentEntry{"phd-5.3", "track-before-detect systems side by side: P-PHD section 5.3", 100,
                    run_phd_5_3, true},
    ExperimentEntry{"dim-target", "one target at 12, 6 and 3 dB, and noise alone", 20,
                    run_dim_target},
    ExperimentEntry{"consistency", "what trackers state about themselves at 3 and 6 dB", 20,
                    run_consistency},
    ExperimentEntry{"dim-field", "two hundred targets in 512x512 pixels", 4, run_dim_field, true},
    ExperimentEntry{"cue", "a cue within 3 px of a target at 3 dB, and one upon noise", 20,
                    run_cue},
    ExperimentEntry{"hpmht-table2",
                    "a dark aircraft before clouds, sensor_area 100 px^2: P-HPMHT table 2", 20,
                    run_hpmht_table_2, true},
    ExperimentEntry{"hpmht-table3",
                    "the same at other thresholds, sensor_area the frame: P-HPMHT table 3", 20,
                    run_hpmht_table_3, true},
    ExperimentEntry{"jpda-fig2", "three aircraft past each other on radar: P-JPDA figure 2", 2000,
                    run_jpda_fig2},
    ExperimentEntry{"jpda-coalescence", "two targets that are one point for a while", 100,
                    run_jpda_coalescence},
    ExperimentEntry{"pmht-table1", "fast targets seen as points, and clutter: P-PMHT table 1", 100,
                    run_pmht_table_1},
    ExperimentEntry{"pmht-montecarlo", "three paths that turn or not: P-PMHT section 4", 50,
                    run_pmht_monte_carlo},
    ExperimentEntry{"pmht-40targets", "forty targets at once: P-PMHT section 4", 200,
                    run_pmht_40_targets},
    ExperimentEntry{"mmpf-tableA", "particle filters on fast targets: P-MMPF table A", 30,
                    run_mmpf_table_a},
};

}  // namespace

std::span<const ExperimentEntry> all_experiments() { return kExperiments; }

const ExperimentEntry& find_experiment(std::string_view name,
                                       std::span<const ExperimentEntry> list) {
  std::string known;
  for (const ExperimentEntry& experiment : list) {
    if (experiment.name == name) return experiment;
    known += (known.empty() ? "" : ", ") + std::string(experiment.name);
  }
  throw ConfigError("there is no experiment '" + std::string(name) + "'; choose one of " + known);
}

ExperimentResult run_experiment(const ExperimentEntry& entry, ExperimentOptions options,
                                Workers& workers) {
  if (options.runs < 0) throw ConfigError("runs must be at least 1");
  if (options.runs == 0) options.runs = entry.runs;
  ExperimentResult result = entry.run(options, workers);
  result.name = entry.name;
  result.runs = options.runs;
  result.seed = options.seed;
  return result;
}

bool bands_hold(const ExperimentResult& result) {
  return std::all_of(result.rows.begin(), result.rows.end(),
                     [](const ExperimentRow& row) { return row.inside().value_or(true); });
}

Summary summarise(std::span<const double> values) {
  double sum = 0, squares = 0, count = 0;
  for (const double v : values) {
    if (!std::isnan(v)) sum += v, ++count;
  }
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (count == 0) return {kNone, kNone};
  const double mean = sum / count;
  for (const double v : values) {
    if (!std::isnan(v)) squares += (v - mean) * (v - mean);
  }
  return {mean, count > 1 ? std::sqrt(squares / (count - 1)) : 0};
}

ExperimentRow value_row(std::string name, std::string metric, const std::vector<double>& values,
                        const std::optional<Band>& band, const std::optional<double>& paper) {
  const Summary summary = summarise(values);
  ExperimentRow row;
  row.name = std::move(name), row.metric = std::move(metric);
  row.ours = summary.mean, row.spread = summary.spread;
  row.paper = paper, row.band = band;
  return row;
}

}  // namespace glint
