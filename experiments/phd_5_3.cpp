// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <utility>

#include "glint/engine/scenario/scenes.hpp"
#include "glint/experiments/condition.hpp"
#include "glint/experiments/figures.hpp"
#include "glint/experiments/phd.hpp"
#include "glint/experiments/phd_settings.hpp"

namespace glint {
namespace {

constexpr std::size_t kTargets = 3;
constexpr double kSigma = 0.6;  // of the point spread [px]
constexpr double kStep = 2;     // [s] a frame

/// A column of tables 2, 3 and 4; missing where the paper prints none.
using ByTarget = std::array<std::optional<double>, kTargets>;

/// What the paper prints of a tracker, and what a right implementation attains.
struct Contender {
  TrackerSetup setup;
  std::optional<double> detected, false_tracks;  // table 2: [%], in 100 runs
  ByTarget found{}, halted{};                    // tables 3 and 4 [frame]
  std::optional<Band> detected_band{}, false_band{}, ospa_band{};
};

Band at_least(double low) { return {low, {}}; }
Band at_most(double high) { return {{}, high}; }

/// Particle filters with births from two frames and J = 5000.
Settings particle_settings(double noise) {
  return phd::appearance(kSigma, 11, 13) + phd::table_1(5000) +
         phd::process_noise(noise, kSigma, kStep) +
         Settings{{"speed_max", 3.0}, {"jitter", 0.5}, {"separation", 2.0}};
}

/// The one list of trackers, in the order of table 2.
std::vector<Contender> contenders() {
  const Settings smc_phd{
      {"motion", "ca"}, {"process_noise", 0.06}, {"confirm_hits", 3}, {"halt_misses", 2}};
  const Settings known{{"motion", "cv+ct"}, {"turn_rate", 6.0}, {"mask_half_width", 0.0}};
  const Settings life{{"confirm_hits", 3}, {"halt_misses", 2}, {"backward_frames", 10}};
  return {
      {{"mm-pf", particle_settings(20) + known},
       94.3,
       1,
       {14.7, 14.3, 24.7},
       {33.5, 34.5, 37.2},
       at_least(94),
       at_most(45),
       {}},
      {{"mm-phd", particle_settings(20) + known + life},
       95.3,
       0,
       {10.7, 10.2, 20.6},
       {31.2, 31.3, 36.3},
       at_least(92),
       at_most(5),
       at_most(1.2)},
      {{"smc-phd", particle_settings(20) + smc_phd},
       92.7,
       0,
       {10.9, 10.3, 20.8},
       {31.4, 31.3, 35.7},
       {},
       {},
       {}},
      {{"h-pmht", {{"psf_sigma", kSigma}, {"snr", 12.0}, {"speed_max", 3.0}}},
       41,
       3,
       {},
       {},
       at_least(78),
       at_most(40),
       {}},
      {{"viterbi",
        phd::appearance(kSigma, 11, 13) +
            Settings{{"speed_max", 3.0}, {"acceleration_max", 2.0}, {"threshold", 30.0}}},
       60,
       21,
       {},
       {},
       at_least(98),
       at_most(30),
       at_most(2.05)},
      {{"smc-phd-improved", particle_settings(1) + smc_phd}, {}, {}, {}, {}, {}, {}, {}},
  };
}

void add_target_figures(const Contender& contender, std::vector<Figure>& figures) {
  const auto target = [](std::size_t t) { return "target " + std::to_string(t + 1); };
  for (std::size_t t = 0; t < kTargets; ++t) {
    figures.push_back({target(t) + " confirmed [frame]",
                       [t](const SceneRun& r) { return confirmed_at(r, t); }, contender.found[t]});
  }
  for (std::size_t t = 0; t < kTargets; ++t) {
    figures.push_back({target(t) + " halted [frame]",
                       [t](const SceneRun& r) { return halted_at(r, t); }, contender.halted[t]});
  }
}

Figure ospa_figure(const std::optional<Band>& band) {
  return {"OSPA, revised [px]",
          [](const SceneRun& r) { return ospa_while_present(r, &SceneRun::revised); },
          {},
          band};
}

std::vector<Figure> figures_of(const Contender& contender) {
  using Run = const SceneRun&;
  constexpr Record kRevised = &SceneRun::revised, kOnline = &SceneRun::online;
  std::vector<Figure> figures{
      {"targets detected [%]", [](Run r) { return detected_targets(r, kRevised); },
       contender.detected, contender.detected_band},
      {"false tracks in 100 runs", [](Run r) { return false_tracks_in_100(r, kRevised); },
       contender.false_tracks, contender.false_band},
      ospa_figure(contender.ospa_band),
      {"OSPA, online [px]", [](Run r) { return ospa_while_present(r, kOnline); }},
      {"OSPA, empty frames [px]", [](Run r) { return ospa_while_empty(r, kRevised); }},
      {"GOSPA, revised [px]", [](Run r) { return r.revised.scores.mean_gospa.distance; }},
      {"cardinality error", [](Run r) { return r.revised.scores.mean_cardinality_error; }},
      {"RMSE, revised [px]", [](Run r) { return rmse(r, kRevised); }},
  };
  add_target_figures(contender, figures);
  return figures;
}

/// Figures 7 and 8.
void add_curves(const Condition& condition, const Runs& runs, ExperimentResult& result) {
  const auto ospa = [](const SceneRun& r, std::size_t k) {
    return r.revised.scores.ospa[k].distance;
  };
  result.curves.push_back(mean_curve("all targets", condition.name, "ospa", runs, ospa));
  for (std::size_t t = 0; t < kTargets; ++t) {
    result.curves.push_back(
        rmse_curve("target " + std::to_string(t + 1), condition.name, runs, &SceneRun::revised, t));
  }
}

}  // namespace

ExperimentResult run_phd_5_3(const ExperimentOptions& options, Workers& workers) {
  std::vector<Condition> conditions;
  for (const Contender& contender : contenders()) {
    Condition& condition = conditions.emplace_back();
    condition.name = contender.setup.tracker;
    condition.scene = make_scene(PhdArcsScene{});
    condition.setup = contender.setup;
    condition.figures = figures_of(contender);
  }
  ExperimentResult result;
  const std::vector<Runs> runs = run_conditions(conditions, options, workers, result);
  const auto of = [&](const char* name) -> std::size_t {
    const auto at = std::ranges::find(conditions, name, &Condition::name);
    return static_cast<std::size_t>(at - conditions.begin());
  };
  Figure gain = ospa_figure(at_least(0.2));
  gain.metric = "OSPA below that of smc-phd [px]";
  result.rows.push_back(gain_row("mm-phd", gain, runs[of("mm-phd")], runs[of("smc-phd")]));
  for (std::size_t i = 0; i < conditions.size(); ++i) add_curves(conditions[i], runs[i], result);
  return result;
}

}  // namespace glint
