// SPDX-License-Identifier: Apache-2.0
#include <numbers>
#include <utility>

#include "glint/engine/scenario/scenes.hpp"

namespace glint {
namespace {

constexpr double kRadian = std::numbers::pi / 180;

/// The paper's place [px] and velocity [px/s], in Glint's coordinates.
Kinematics at(double x, double vx, double y, double vy) { return {x - 0.5, y - 0.5, vx, vy}; }

/// Seen from the paper's frame `first` to its frame `last`, both included.
ScriptedTarget seen(int first, int last, double intensity, Path path) {
  return {first - 1, last, intensity, std::move(path)};
}

}  // namespace

void describe(FieldList& list, PhdScene& config) {
  list("snr", config.snr, -20, 40, "dB", "peak of the target's image above the noise");
  list("jitter", config.jitter, 0, 5, "px", "sd of the image about the target, anew each frame");
  list("frames", config.frames, 1, 100000, "", "length of the sequence");
}

Scene make_scene(const PhdScene& config) {
  Scene scene;
  scene.name = PhdScene::kName;
  scene.width = scene.height = 40;
  scene.frames = config.frames;
  scene.point_spread = PointSpread::of(0.7);
  scene.jitter_sigma = config.jitter;
  const double intensity = scene.point_spread.intensity_of_snr(config.snr);  // P-PHD (37)
  scene.targets = {seen(5, 24, intensity, fly(at(5, 0.9, 5, 0.2)))};
  return scene;
}

void describe(FieldList& list, PhdManoeuvreScene& config) {
  list("snr", config.snr, -20, 40, "dB", "peak of a target's image above the noise");
  list("jitter", config.jitter, 0, 5, "px", "sd of the image about the target, anew each frame");
  list("turn_rate", config.turn_rate, 0, 90, "deg/s", "of the targets that turn");
}

Scene make_scene(const PhdManoeuvreScene& config) {
  Scene scene;
  scene.name = PhdManoeuvreScene::kName;
  scene.width = scene.height = 40;
  scene.frames = 40;
  scene.point_spread = PointSpread::of(0.7);
  scene.jitter_sigma = config.jitter;
  const double intensity = scene.point_spread.intensity_of_snr(config.snr);
  // Anticlockwise with the paper's y up is from x towards y.
  const double rate = config.turn_rate * kRadian;
  scene.targets = {
      seen(5, 34, intensity, fly(at(15, 1.5, 10, 0), {{10, 0}, {10, rate}})),
      seen(5, 34, intensity, fly(at(25, -1.3, 18, 0), {{10, 0}, {10, -rate}})),
      seen(10, 30, intensity, fly(at(20, 0, 35, -1.5))),
  };
  return scene;
}

void describe(FieldList& list, PhdArcsScene& config) {
  list("snr", config.snr, -20, 40, "dB", "peak of the first two targets' images above the noise");
  list("snr_third", config.snr_third, -20, 40, "dB", "the same of the third target");
  list("jitter", config.jitter, 0, 5, "px", "sd of the image about the target, anew each frame");
  list("turn_rate", config.turn_rate, 0, 90, "deg/s", "of all targets, each way");
}

Scene make_scene(const PhdArcsScene& config) {
  Scene scene;
  scene.name = PhdArcsScene::kName;
  scene.width = 80, scene.height = 100;
  scene.frames = 42;
  scene.interval = 2;
  scene.point_spread = PointSpread::of(0.6);
  scene.jitter_sigma = config.jitter;
  const double bright = scene.point_spread.intensity_of_snr(config.snr);
  const double dim = scene.point_spread.intensity_of_snr(config.snr_third);
  const double straight = 6 * scene.interval, turn = 8 * scene.interval, rest = 100;  // [s]
  const double rate = config.turn_rate * kRadian;  // anticlockwise, as above
  scene.targets = {
      seen(8, 29, bright, fly(at(15, 0.9, 20, 0.45), {{straight, 0}, {turn, rate}})),
      seen(8, 29, bright, fly(at(66, -0.75, 28, 0.7), {{straight, 0}, {turn, -rate}})),
      seen(15, 34, dim, fly(at(30, 0.35, 85, -0.95), {{straight, 0}, {turn, rate}, {rest, -rate}})),
  };
  return scene;
}

}  // namespace glint
