// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/point_contests.hpp"

#include <algorithm>
#include <type_traits>

#include "glint/bench/baselines/plain_jpda.hpp"
#include "glint/bench/baselines/plain_particles.hpp"
#include "glint/bench/baselines/plain_pda.hpp"
#include "glint/bench/baselines/plain_pmht.hpp"
#include "glint/engine/scenario/point_sensor.hpp"
#include "glint/engine/scenario/scenes.hpp"

namespace glint::bench {
namespace {

// Tracks start where they are told, and never end.
template <class Config>
Config for_known(const PointScans& scans) {
  Config config;
  config.initiate = false;
  config.clutter_density = scans.clutter_density;
  if constexpr (std::is_base_of_v<PointTrackConfig, Config>) {
    keep_to_known(config);
  } else {
    config.measurement_variance = 1, config.life.halt_misses = 1000, config.separation = 0;
  }
  return config;
}

template <class T, class Config>
PointStates follow(const PointScans& scans, std::uint64_t seed) {
  T tracker(for_known<Config>(scans), Device::tbb(1), seed);
  for (const Kinematics& k : scans.starts) tracker.start(k.x, k.y, k.vx, k.vy);
  TrackLog log;
  Scan scan;
  for (std::size_t k = 0; k < scans.points.size(); ++k) {
    scan.frame = static_cast<std::int64_t>(k), scan.time = static_cast<double>(k);
    scan.points = scans.points[k];
    tracker.step(scan, log);
  }
  PointStates states;
  for (const TrackPoint& p : log.at(scan.frame)) states.emplace_back(p.x, p.vx, p.y, p.vy);
  return states;
}

// The first scan is that of the starts.
template <class T>
PointStates follow_plainly(T tracker, const PointScans& scans) {
  for (std::size_t k = 1; k < scans.points.size(); ++k) tracker.step(scans.points[k]);
  return tracker.states();
}

template <class T, class Config>
PointStates follow_plainly(const PointScans& scans, std::uint64_t /*seed*/) {
  T tracker(for_known<Config>(scans));
  for (const Kinematics& k : scans.starts) tracker.start(k.x, k.y, k.vx, k.vy);
  return follow_plainly(std::move(tracker), scans);
}

PointStates follow_with_particles(const PointScans& scans, std::uint64_t seed) {
  PlainParticles tracker(for_known<MmpfPmhtConfig>(scans), static_cast<std::uint32_t>(seed));
  for (const Kinematics& k : scans.starts) tracker.start(k.x, k.y, k.vx, k.vy);
  return follow_plainly(std::move(tracker), scans);
}

PointStates follow_apart(const PointScans& scans, std::uint64_t /*seed*/) {
  PlainPda tracker(for_known<ImmPdaAiConfig>(scans));
  const auto amplitude = static_cast<double>(scans.points[0][0].amplitude);
  for (const Kinematics& k : scans.starts) tracker.start(k.x, k.y, k.vx, k.vy, amplitude);
  return follow_plainly(std::move(tracker), scans);
}

template <class Config>
PointContest of_pmht(const std::string& name) {
  return {name, "dense weights", follow<Pmht, Config>, follow_plainly<PlainPmht, Config>};
}

template <class Config>
PointContest of_jpda(const std::string& name) {
  return {name, "every joint event", follow<ImmJpda, Config>, follow_plainly<PlainJpda, Config>};
}

}  // namespace

PointScans forty_targets(std::size_t targets, std::size_t scans) {
  constexpr double kPercent = 0.02;
  constexpr std::uint64_t kSeed = 1;
  PmhtClipScene config;
  config.clip = "crowd";
  Scene scene = make_scene(config);
  scene.targets.resize(targets);
  PointSensor sensor;
  sensor.clutter = PointSensor::clutter_of(scene, kPercent);
  PointScans all;
  all.clutter_density = sensor.clutter_density(scene);
  for (const ScriptedTarget& target : scene.targets) all.starts.push_back(target.path(0));
  for (std::size_t k = 0; k < scans; ++k) {
    all.points.push_back(points_at(scene, sensor, kSeed, static_cast<int>(k)));
  }
  return all;
}

std::vector<PointContest> point_contests() {
  return {{"imm-pda-ai", "one by one", follow<ImmPdaAi, ImmPdaAiConfig>, follow_apart},
          of_jpda<ImmJpdaConfig>("imm-jpda"),
          of_jpda<ImmMscanJpdaConfig>("imm-mscan-jpda"),
          {"mmpf-pmht", "std::normal_distribution", follow<MmpfPmht, MmpfPmhtConfig>,
           follow_with_particles, 15, 0.5},
          of_pmht<PmhtConfig>("pmht-imm"),
          of_pmht<PmhtCaConfig>("pmht-ca"),
          of_pmht<PmhtSingerConfig>("pmht-singer"),
          of_pmht<PmhtHomotheticConfig>("pmht-homothetic")};
}

}  // namespace glint::bench
