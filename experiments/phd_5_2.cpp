// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "glint/engine/scenario/scenes.hpp"
#include "glint/experiments/condition.hpp"
#include "glint/experiments/figures.hpp"
#include "glint/experiments/phd.hpp"
#include "glint/experiments/phd_settings.hpp"

namespace glint {
namespace {

constexpr std::size_t kTargets = 3;
constexpr double kSigma = 0.7;  // of the point spread [px]
constexpr double kSnr = 10;     // [dB]

/// P-PHD table 1, births from two frames, the life of a track of section 4.2.
Settings mm_phd_settings(double snr, double jitter) {
  return phd::appearance(kSigma, snr, snr) + phd::table_1(2000) +
         phd::process_noise(20, kSigma, 1) + Settings{{"jitter", jitter},
                                                      {"motion", "cv+ct"},
                                                      {"turn_rate", PhdManoeuvreScene{}.turn_rate},
                                                      {"speed_max", 4.0},
                                                      {"confirm_hits", 3},
                                                      {"halt_misses", 2},
                                                      {"mask_half_width", 0.0},
                                                      {"separation", 2.0},
                                                      {"backward_frames", 10}};
}

/// Weight of the turning models, mean over the frames in which target `t` turns.
double turning_while_turning(const SceneRun& run, std::size_t t) {
  // The paper's targets turn for 10 s from 10 s after they appear at frame 5.
  constexpr std::size_t kFirst = 15, kLast = 23;
  double sum = 0, frames = 0;
  for (std::size_t k = kFirst; k <= kLast; ++k) {
    const ModeProbability& p = run.online.targets[t].modes[k];
    if (p.size() == 3) sum += p[1] + p[2], ++frames;
  }
  return frames > 0 ? sum / frames : kUndefined;
}

std::vector<Figure> figures_of(bool banded) {
  using Run = const SceneRun&;
  constexpr Record kRevised = &SceneRun::revised, kOnline = &SceneRun::online;
  const auto band = [&](std::optional<double> low, std::optional<double> high) {
    return banded ? std::optional(Band{low, high}) : std::nullopt;
  };
  std::vector<Figure> figures{
      {"OSPA, revised [px]",
       [](Run r) { return ospa_while_present(r, kRevised); },
       {},
       band({}, 1.2)},
      {"OSPA, online [px]",
       [](Run r) { return ospa_while_present(r, kOnline); },
       {},
       band({}, 2.1)},
      {"OSPA, empty frames [px]",
       [](Run r) { return ospa_while_empty(r, kRevised); },
       {},
       band({}, 0.15)},
      {"GOSPA, revised [px]", [](Run r) { return r.revised.scores.mean_gospa.distance; }},
      {"cardinality error", [](Run r) { return r.revised.scores.mean_cardinality_error; }},
      {"RMSE, revised [px]", [](Run r) { return rmse(r, kRevised); }},
      {"false tracks in 100 runs",
       [](Run r) { return false_tracks_in_100(r, kRevised); },
       {},
       band({}, 8)},
  };
  for (std::size_t t = 0; t < kTargets; ++t) {
    const std::string target = "target " + std::to_string(t + 1);
    figures.push_back({target + " detected [%]",
                       [t](Run r) { return target_detected(r, kRevised, t); },
                       {},
                       band(97, {})});
    figures.push_back({target + " confirmed [frame]", [t](Run r) { return confirmed_at(r, t); }});
  }
  return figures;
}

std::vector<Condition> conditions() {
  std::vector<Condition> all(3);
  for (Condition& condition : all) {
    condition.scene = make_scene(PhdManoeuvreScene{});
    condition.setup = {"mm-phd", mm_phd_settings(kSnr, 0.5)};
  }
  all[0].name = "mm-phd", all[0].figures = figures_of(true);
  all[1].name = "one CV model", all[1].figures = figures_of(false);
  all[1].setup.settings.push_back({"motion", "cv"});
  // What the models' probabilities say shows only where little else is uncertain.
  PhdManoeuvreScene clear;
  clear.snr = 20, clear.jitter = 0;
  all[2].name = "mm-phd", all[2].level = "20 dB, no jitter";
  all[2].scene = make_scene(clear);
  all[2].setup.settings = mm_phd_settings(20, 0);
  for (std::size_t t = 0; t < 2; ++t) {
    all[2].figures.push_back({"target " + std::to_string(t + 1) + ", P(turn) while it turns",
                              [t](const SceneRun& r) { return turning_while_turning(r, t); },
                              {},
                              Band{0.5, {}}});
  }
  return all;
}

/// Figures 4 and 5.
void add_curves(const Condition& condition, const Runs& runs, ExperimentResult& result) {
  result.curves.push_back(mean_curve(
      "all targets", condition.title(), "ospa", runs,
      [](const SceneRun& r, std::size_t k) { return r.revised.scores.ospa[k].distance; }));
  const std::vector<std::string>& modes = runs.front().mode_names;
  for (std::size_t t = 0; t < kTargets; ++t) {
    const std::string target = "target " + std::to_string(t + 1);
    result.curves.push_back(rmse_curve(target, condition.title(), runs, &SceneRun::revised, t));
    if (modes.size() < 2) continue;
    const std::string level = condition.level.empty() ? target : target + ", " + condition.level;
    for (std::size_t m = 0; m < modes.size(); ++m) {
      const auto probability = [t, m](const SceneRun& r, std::size_t k) {
        const ModeProbability& p = r.online.targets[t].modes[k];
        return m < p.size() ? p[m] : kUndefined;
      };
      result.curves.push_back(
          mean_curve(level, condition.name + ", " + modes[m], "p", runs, probability));
    }
  }
}

}  // namespace

ExperimentResult run_phd_5_2(const ExperimentOptions& options, Workers& workers) {
  ExperimentResult result;
  const std::vector<Condition> all = conditions();
  const std::vector<Runs> runs = run_conditions(all, options, workers, result);
  Figure gain = all[0].figures.front();
  gain.metric = "OSPA below that of one CV model [px]";
  gain.band = Band{0.25, {}};
  result.rows.push_back(gain_row(all[0].name, gain, runs[0], runs[1]));
  for (std::size_t i = 0; i < all.size(); ++i) add_curves(all[i], runs[i], result);
  return result;
}

}  // namespace glint
