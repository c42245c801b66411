// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/workers.hpp"

namespace glint {

class RunStore;
class RunTeam;

/// Where a figure must lie; an end that is missing is open.
struct Band {
  std::optional<double> low, high;
  bool holds(double value) const {  // NaN lies in no band
    return value == value && !(low && value < *low) && !(high && value > *high);
  }
  /// The same with each end `by` further out.
  Band widened(double by) const {
    Band band = *this;
    if (band.low) *band.low -= by;
    if (band.high) *band.high += by;
    return band;
  }
};

/// One figure of an experiment.
struct ExperimentRow {
  std::string name, metric;     ///< tracker or condition; what was measured
  double ours = 0, spread = 0;  ///< mean and standard deviation over runs
  std::optional<double> paper;  ///< what the paper prints
  std::optional<Band> band;     ///< what a right implementation attains
  std::optional<bool> inside() const {
    return band ? std::optional(band->holds(ours)) : std::nullopt;
  }
};

/// One value over frames, mean over runs.
struct Curve {
  std::string level;  ///< what conditions are compared at: "10 dB"
  std::string condition, metric;
  std::vector<double> frame, value;
};

struct ExperimentResult {
  std::string name;
  int runs = 0;
  std::uint64_t seed = 0;
  std::vector<ExperimentRow> rows;
  std::vector<Curve> curves;
};

struct ExperimentOptions {
  int runs = 0;  ///< 0 = the experiment's own number
  std::uint64_t seed = 1;
  std::string data;  ///< folder of recorded data, for experiments that need one
  /// Where trackers of frames run their kernels, for entries `on_device`; by default each run has a
  /// thread of the processor.
  std::optional<Device> device = {};
  /// Called with runs done and runs in all, from any thread, one call at a time.
  std::function<void(int done, int total)> progress;
  RunStore* store = nullptr;  ///< keeps finished runs, and has those that need not be repeated
  RunTeam* team = nullptr;    ///< processes to share the runs with
};

/// How an experiment is found by name and run.
struct ExperimentEntry {
  std::string_view name, summary;
  int runs;  ///< that the bands hold for
  ExperimentResult (*run)(const ExperimentOptions& options, Workers& workers);
  bool on_device = false;  ///< whether it can run on another device than a thread each
};

/// The one list of experiments that need no recorded data.
std::span<const ExperimentEntry> all_experiments();
/// Throws ConfigError that lists the names if there is no such experiment in `list`.
const ExperimentEntry& find_experiment(std::string_view name,
                                       std::span<const ExperimentEntry> list = all_experiments());

/// Runs it. The result depends on runs and seed alone, never on the number of workers.
/// Throws ConfigError for less than no runs, RunsTakenElsewhere in a team that another leads.
ExperimentResult run_experiment(const ExperimentEntry& entry, ExperimentOptions options,
                                Workers& workers);

/// False if a band is missed.
bool bands_hold(const ExperimentResult& result);

/// Mean and standard deviation over runs, NaN left out; both NaN if nothing is left.
struct Summary {
  double mean = 0, spread = 0;
};
Summary summarise(std::span<const double> values);
/// One value a run: its mean and spread.
ExperimentRow value_row(std::string name, std::string metric, const std::vector<double>& values,
                        const std::optional<Band>& band = {},
                        const std::optional<double>& paper = {});

/// A member of every run's result, times `scale`.
template <class Run>
std::vector<double> column(const std::vector<Run>& runs, double Run::*member, double scale = 1) {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const Run& run : runs) values.push_back(scale * run.*member);
  return values;
}

}  // namespace glint
