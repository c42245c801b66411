// SPDX-License-Identifier: Apache-2.0
// A small scene of dim point targets in white noise, and what a tracker says of it.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "glint/engine/scenario/scenario.hpp"
#include "glint/engine/tracks/track_log.hpp"
#include "glint/experiments/scene_run.hpp"

namespace glint::test {

/// Of `snr` [dB]. `birth` <= frame < `death`.
inline ScriptedTarget target(int birth, int death, const Kinematics& start, double snr) {
  return {birth, death, PointSpread::of(0.7).intensity_of_snr(snr), fly(start)};
}

/// 40x40 pixels, sigma .7.
inline Scene scene_of(std::vector<ScriptedTarget> targets, int frames = 30) {
  Scene s;
  s.name = "test", s.width = s.height = 40, s.frames = frames;
  s.point_spread = PointSpread::of(0.7);
  s.targets = std::move(targets);
  return s;
}

inline Scene one_target(double snr, int birth, int death) {
  return scene_of({target(birth, death, {6, 8, 0.9, 0.3}, snr)});
}

/// Far from each other.
inline Scene two_targets(double snr, int birth, int death) {
  return scene_of({target(birth, death, {6, 8, 0.9, 0.3}, snr),
                   target(birth, death, {32, 30, -0.8, -0.4}, snr)});
}

/// What a tracker T with this config says of the scene.
template <class T, class Config>
TrackLog track(const Scene& scene, const Config& config, std::uint64_t seed = 1) {
  TrackLog log;
  T tracker(config, Device::tbb(1), seed);
  for (int k = 0; k < scene.frames; ++k) tracker.step(whitened_scan(scene, seed, k), log);
  tracker.finish(log);
  return log;
}

inline std::vector<TrackPoint> confirmed(const std::vector<TrackPoint>& points) {
  std::vector<TrackPoint> kept;
  std::ranges::copy_if(points, std::back_inserter(kept),
                       [](const auto& p) { return p.status == TrackStatus::confirmed; });
  return kept;
}

inline std::set<std::int64_t> ids(const std::vector<TrackPoint>& points) {
  std::set<std::int64_t> set;
  for (const auto& p : points) set.insert(p.track_id);
  return set;
}

inline std::set<std::int64_t> confirmed_ids(const TrackLog& log) {
  return ids(confirmed(log.online()));
}

inline bool any_halted(const TrackLog& log) {
  return std::ranges::any_of(log.online(),
                             [](const auto& p) { return p.status == TrackStatus::halted; });
}

/// The frame at which anything was said first; 99 for never.
inline std::int64_t first_frame(const std::vector<TrackPoint>& points) {
  return points.empty() ? 99 : points.front().frame;
}

/// From the point to the nearest target at its frame [px]; 1e9 if there is none.
inline double distance_to_truth(const Scene& scene, const TrackPoint& p) {
  double nearest = 1e9;
  for (const auto& t : truth_at(scene, static_cast<int>(p.frame))) {
    nearest = std::min(nearest, std::hypot(p.x - t.x, p.y - t.y));
  }
  return nearest;
}

/// Confirmed tracks in `frames` of pure noise, over `seeds` seeds.
template <class T, class Config>
std::size_t declared_in_noise(const Config& config, int frames, std::uint64_t seeds) {
  std::size_t declared = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    declared += confirmed_ids(track<T>(scene_of({}, frames), config, seed)).size();
  }
  return declared;
}

}  // namespace glint::test
