// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "glint/engine/scenario/scenes.hpp"
#include "glint/experiments/monte_carlo.hpp"
#include "glint/experiments/phd.hpp"
#include "glint/experiments/phd_settings.hpp"
#include "glint/experiments/scene_run.hpp"

namespace glint {
namespace {

constexpr std::array kTrackers{"mm-phd", "mm-pf", "smc-phd", "viterbi", "h-pmht"};
constexpr std::size_t kParticleFilters = 3;  // the first ones: their covariances have bands

/// Targets that manoeuvre as the trackers expect: by their default process_noise.
constexpr double kManoeuvre = .02;  // [px^2/frame^2]
struct Field {
  int size;           // [px]
  double speed, snr;  // [px/frame], [dB]
};
constexpr std::array kFields{Field{64, 1.5, 3}, Field{64, 1.5, 6}, Field{256, 3, 3},
                             Field{256, 3, 6}};

/// The trackers' own settings, but for how dim a target may be.
TrackerSetup setup_of(const std::string& tracker) {
  if (tracker == "h-pmht") return {tracker, {{"snr", 6.0}}};
  return phd::dim_target_setup(tracker);
}

Consistency run_of(const char* tracker, const Field& field, std::uint64_t seed) {
  DimTargetScene config;
  config.size = field.size, config.snr = field.snr;
  config.speed = field.speed, config.manoeuvre = kManoeuvre;
  config.variant = static_cast<int>(seed);
  return run_scene(make_scene(config), setup_of(tracker), seed).online.consistency;
}

/// Each run's part of a ratio of sums: the parts' mean is the ratio.
template <class Above, class Below>
std::vector<double> parts(const std::vector<Consistency>& runs, const Above& above,
                          const Below& below) {
  double whole = 0;
  for (const Consistency& run : runs) whole += below(run);
  std::vector<double> values;
  values.reserve(runs.size());
  for (const Consistency& run : runs) {
    values.push_back(above(run) * static_cast<double>(runs.size()) / whole);
  }
  return values;
}

std::vector<double> mean_over_points(const std::vector<Consistency>& runs,
                                     PointSum Consistency::*of) {
  return parts(
      runs, [of](const Consistency& c) { return (c.*of).sum; },
      [of](const Consistency& c) { return static_cast<double>((c.*of).points); });
}

/// Brier's score of all points of all runs over that of their base rate.
std::vector<double> brier_ratio(const std::vector<Consistency>& runs) {
  Consistency all;
  for (const Consistency& run : runs) {
    all.existence_error.points += run.existence_error.points, all.real += run.real;
  }
  const double base = all.brier_of_base_rate();
  return parts(
      runs, [](const Consistency& c) { return c.existence_error.sum; },
      [base](const Consistency& c) {
        return base * static_cast<double>(c.existence_error.points);
      });
}

/// What is right: NEES of 2 and of 4; existence that knows more than how frequent targets are.
struct Bands {
  std::optional<Band> position, state, existence;
};

void add_rows(const std::string& name, const std::vector<Consistency>& runs, const Bands& bands,
              ExperimentResult& result) {
  const auto add = [&](const char* metric, const std::vector<double>& values,
                       const std::optional<Band>& band) {
    result.rows.push_back(value_row(name, metric, values, band));
  };
  add("NEES of position", mean_over_points(runs, &Consistency::position_nees), bands.position);
  add("NEES of position and velocity", mean_over_points(runs, &Consistency::state_nees),
      bands.state);
  add("Brier / base rate's", brier_ratio(runs), bands.existence);
}

}  // namespace

ExperimentResult run_consistency(const ExperimentOptions& options, Workers& workers) {
  const auto runs = run_cases(kTrackers.size() * kFields.size(), options, workers,
                              [&](std::size_t which, std::size_t run) {
                                return run_of(kTrackers[which / kFields.size()],
                                              kFields[which % kFields.size()], options.seed + run);
                              });
  ExperimentResult result;
  for (std::size_t t = 0; t < kTrackers.size(); ++t) {
    std::vector<Consistency> all;
    for (std::size_t f = 0; f < kFields.size(); ++f) {
      const std::vector<Consistency>& some = runs[t * kFields.size() + f];
      all.insert(all.end(), some.begin(), some.end());
    }
    Bands bands;
    bands.existence = Band{{}, kTrackers[t] == std::string("h-pmht") ? .75 : .6};
    if (t < kParticleFilters) bands.position = Band{1.5, 2.6}, bands.state = Band{3.2, 4.8};
    add_rows(kTrackers[t], all, bands, result);
    for (std::size_t f = 0; f < kFields.size(); ++f) {
      add_rows(std::string(kTrackers[t]) + ", " + std::to_string(kFields[f].size) + " px, " +
                   std::to_string(static_cast<int>(kFields[f].snr)) + " dB",
               runs[t * kFields.size() + f], {}, result);
    }
  }
  return result;
}

}  // namespace glint
