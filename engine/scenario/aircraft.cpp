// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "glint/engine/scenario/scenes.hpp"
#include "glint/engine/scenario/smooth_noise.hpp"

namespace glint {
namespace {

constexpr int kSide = 200;                  // [px]
constexpr double kSky = 165, kCloudSd = 6;  // [grey levels]
/// Noise of 4 grey levels in each of R, G and B, after P-HPMHT (1).
constexpr double kNoise = 4 * 0.66857;

/// P-HPMHT table 1.
struct Scenario {
  double speed, snr, area;  // [px/frame], [dB], [px^2]
  Aircraft kind;            // ours
};
constexpr std::array<Scenario, 7> kScenarios{{{2.7, 4.9, 200, Aircraft::jet},
                                              {4.0, 4.7, 260, Aircraft::jet},
                                              {3.4, 3.9, 232, Aircraft::jet},
                                              {3.0, 2.6, 84, Aircraft::jet},
                                              {2.4, 3.7, 75, Aircraft::helicopter},
                                              {1.5, 7.0, 40, Aircraft::helicopter},
                                              {3.2, 7.6, 350, Aircraft::helicopter}}};

/// Uniform in (0, 1), by what is drawn.
double draw(int variant, std::uint32_t item) {
  return uniform(
      random_words(random_key(static_cast<std::uint64_t>(variant), 1, Purpose::scenario), item)
          .w[0]);
}

Image<float> cloudy_sky(int variant, double clutter) {
  const auto noise = [variant](int cell, std::uint64_t octave) {
    return SmoothNoise(kSide, kSide, cell, 16 * static_cast<std::uint64_t>(variant) + octave);
  };
  const SmoothNoise large = noise(60, 1), medium = noise(26, 2), small = noise(12, 3);
  Image<float> image(kSide, kSide);
  const ImageView<float> out = image.view();
  double sum = 0, squares = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double cloud = large(x, y) + 0.5 * medium(x, y) + 0.2 * small(x, y);
      out(x, y) = static_cast<float>(cloud);
      sum += cloud, squares += cloud * cloud;
    }
  }
  const double mean = sum / (kSide * kSide);
  const double scale = clutter * kCloudSd / std::sqrt(squares / (kSide * kSide) - mean * mean);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      out(x, y) = static_cast<float>(kSky + scale * (static_cast<double>(out(x, y)) - mean));
    }
  }
  return image;
}

double mean_reciprocal(FrameView image) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) sum += 255 / static_cast<double>(image(x, y));
  }
  return sum / (image.width * image.height);  // P-HPMHT (2)
}

/// An S of two turns, anywhere in the picture where a target of `radius` [px] stays inside.
Path curved_path(int variant, double speed, double duration, double interval, double radius) {
  const double heading = 2 * std::numbers::pi * draw(variant, 0);
  const double turned = (0.5 + 0.7 * draw(variant, 1)) * (draw(variant, 2) < 0.5 ? -1 : 1);
  const double v = speed / interval, half = duration * interval / 2;
  Kinematics start{0, 0, v * std::cos(heading), v * std::sin(heading)};
  const std::vector<Leg> legs{{half, turned / half}, {half, -turned / half}};
  const Path from_origin = fly(start, legs);
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  for (int frame = 0; frame <= duration; ++frame) {
    const Kinematics k = from_origin(frame * interval);
    x0 = std::min(x0, k.x), x1 = std::max(x1, k.x);
    y0 = std::min(y0, k.y), y1 = std::max(y1, k.y);
  }
  const auto place = [radius](double low, double high, double share) {
    const double room = std::max(kSide - 1 - 2 * radius - (high - low), 0.0);
    return (kSide - 1 - (high - low) - room) / 2 + share * room - low;
  };
  start.x = place(x0, x1, draw(variant, 3)), start.y = place(y0, y1, draw(variant, 4));
  return fly(start, legs);
}

}  // namespace

void describe(FieldList& list, AircraftScene& config) {
  list("scenario", config.scenario, 1, 7, "", "row of P-HPMHT table 1: speed, SNR and area");
  list("frames", config.frames, 2, 41, "", "length of the clip, at 25 frames/s");
  list("clutter", config.clutter, 0, 5, "", "clouds: 1 is a standard deviation of 6 grey levels");
  list("variant", config.variant, 0, 1000000, "", "another sky, path and phase of the aircraft");
}

Scene make_scene(const AircraftScene& config) {
  const Scenario& scenario = kScenarios.at(static_cast<std::size_t>(config.scenario - 1));
  Scene scene;
  scene.name = AircraftScene::kName;
  scene.width = scene.height = kSide;
  scene.frames = config.frames;
  scene.interval = 1.0 / 25;
  scene.noise_sigma = kNoise;
  scene.background = cloudy_sky(config.variant, config.clutter);
  scene.grey_levels = true;
  auto silhouette = std::make_shared<Silhouette>();
  silhouette->kind = scenario.kind;
  silhouette->area = scenario.area;
  silhouette->sky = kSky;
  silhouette->reciprocal =
      mean_reciprocal(scene.background.view()) * std::pow(10, scenario.snr / 20);
  silhouette->phase = 2 * std::numbers::pi * draw(config.variant, 5);
  ScriptedTarget target;
  target.death = config.frames;
  const double radius = 1.3 * std::sqrt(scenario.area);
  target.path =
      curved_path(config.variant, scenario.speed, config.frames - 1, scene.interval, radius);
  target.silhouette = std::move(silhouette);
  scene.targets.push_back(std::move(target));
  return scene;
}

}  // namespace glint
