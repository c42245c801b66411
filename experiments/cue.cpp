// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/cue.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "glint/engine/scenario/scenes.hpp"
#include "glint/experiments/monte_carlo.hpp"
#include "glint/experiments/phd.hpp"
#include "glint/experiments/phd_settings.hpp"
#include "glint/experiments/scene_run.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

constexpr std::array kTrackers{"mm-phd", "smc-phd", "mm-pf"};
constexpr double kReach = 3;      // a point this near is the target's, as the cue is [px]
constexpr int kCued = 10;         // frame of the cue: the target's first
constexpr std::size_t kLast = 5;  // frames in which a target that is held is not lost

struct CueRun {
  double held = 0, near = 0, ended = kUndefined;
};
auto fields(OneOf<CueRun> auto& r) { return std::tie(r.held, r.near, r.ended); }

/// The settings of `dim-target`, and as many particles as profile L has.
TrackerSetup setup_of(const std::string& tracker) {
  TrackerSetup setup = phd::dim_target_setup(tracker);
  if (tracker != "smc-phd") setup.settings.push_back({"target_particles", 4000});
  return setup;
}

/// Anywhere within kReach of the place.
Cue cue_near(double x, double y, std::uint64_t seed) {
  const Words4 words = random_words(random_key(seed, kCued, Purpose::cue), 0);
  const double radius = kReach * std::sqrt(static_cast<double>(uniform(words.w[0])));
  const double angle = 2 * std::numbers::pi * static_cast<double>(uniform(words.w[1]));
  return {x + radius * std::cos(angle), y + radius * std::sin(angle)};
}

/// What the track that starts by the cue reports while it lives, likely or not, from the cue's
/// frame on.
std::vector<TrackPoint> follow(const Scene& scene, const char* tracker, const Cue& cue,
                               std::uint64_t seed) {
  const auto own = setup_of(tracker).make(Device::tbb(1), seed);
  TrackLog log;
  for (int k = 0; k < scene.frames; ++k) {
    Scan scan = whitened_scan(scene, seed, k);
    if (k == kCued) scan.cues = std::span(&cue, 1);
    own->step(scan, log);
  }
  const std::vector<TrackPoint> first = log.at(kCued);
  const auto distance = [&](const TrackPoint& p) { return std::hypot(p.x - cue.x, p.y - cue.y); };
  const auto started = std::ranges::min_element(first, {}, distance);
  std::vector<TrackPoint> points;
  if (started == first.end()) return points;
  for (const TrackPoint& p : log.online()) {
    const bool of_track = p.track_id == started->track_id && p.frame >= kCued;
    if (of_track && p.status != TrackStatus::halted) points.push_back(p);
  }
  return points;
}

CueRun on_target(const char* tracker, std::uint64_t seed) {
  DimTargetScene config;
  config.snr = 3, config.variant = static_cast<int>(seed);
  const Scene scene = make_scene(config);
  const TruthPoint first = truth_at(scene, kCued)[0];
  const std::vector<TrackPoint> points =
      follow(scene, tracker, cue_near(first.x, first.y, seed), seed);
  std::vector<double> near;  // by frame of its life: 1 or 0
  for (int k = kCued; k < scene.frames; ++k) {
    for (const TruthPoint& truth : truth_at(scene, k)) {
      near.push_back(std::ranges::any_of(points, [&](const TrackPoint& p) {
        return p.frame == k && std::hypot(p.x - truth.x, p.y - truth.y) <= kReach;
      }));
    }
  }
  CueRun run;
  const auto sum = [](std::span<const double> values) {
    double total = 0;
    for (const double v : values) total += v;
    return total;
  };
  run.near = sum(near) / static_cast<double>(near.size());
  run.held = run.near >= 0.5 && sum(std::span(near).last(kLast)) > kLast / 2.0;
  return run;
}

/// Frames that a track lives on nothing, that of the cue included.
CueRun on_noise(const char* tracker, std::uint64_t seed) {
  NoiseScene config;
  config.width = config.height = 64, config.frames = 100;
  const Scene scene = make_scene(config);
  CueRun run;
  run.ended = static_cast<double>(follow(scene, tracker, cue_near(32, 32, seed), seed).size());
  return run;
}

}  // namespace

ExperimentResult run_cue(const ExperimentOptions& options, Workers& workers) {
  const auto runs =
      run_cases(2 * kTrackers.size(), options, workers, [&](std::size_t which, std::size_t run) {
        const char* tracker = kTrackers[which / 2];
        const std::uint64_t seed = options.seed + run;
        return which % 2 == 0 ? on_target(tracker, seed) : on_noise(tracker, seed);
      });
  ExperimentResult result;
  for (std::size_t i = 0; i < kTrackers.size(); ++i) {
    const bool banded = i == 0;
    const std::string name = kTrackers[i];
    const auto band = [&](std::optional<double> low, std::optional<double> high) {
      return banded ? std::optional(Band{low, high}) : std::nullopt;
    };
    const auto add = [&](const std::string& row, const char* metric,
                         const std::vector<double>& values, std::optional<Band> of = {}) {
      result.rows.push_back(value_row(row, metric, values, of));
    };
    add(name + ", 3 dB", "held", column(runs[2 * i], &CueRun::held), band(.9, {}));
    add(name + ", 3 dB", "share of frames", column(runs[2 * i], &CueRun::near));
    const std::vector<double> ends = column(runs[2 * i + 1], &CueRun::ended);
    add(name + ", noise alone", "ends after [frames]", ends, band({}, 8));
    add(name + ", noise alone", "longest [frames]", {*std::ranges::max_element(ends)});
  }
  return result;
}

}  // namespace glint
