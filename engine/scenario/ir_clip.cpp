// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "glint/engine/scenario/scenes.hpp"
#include "glint/engine/scenario/smooth_noise.hpp"

namespace glint {
namespace {

constexpr int kWidth = 1024, kHeight = 256;
constexpr double kInterval = 1.0 / 30;
constexpr double kSpacing = 110;  // [px] between control points along x

/// One target: where its spline starts, which way it flies, and the heights of its control points.
struct Script {
  double x, direction;
  std::array<double, 10> y;
  double birth, death;  // shares of the clip
};

constexpr std::array<Script, 6> kScripts{{
    {60, 1, {90, 70, 60, 110, 150, 120, 70, 60, 90, 100}, 0.00, 0.85},
    {980, -1, {40, 60, 100, 130, 100, 60, 50, 80, 120, 130}, 0.08, 1.00},
    {330, 1, {170, 150, 110, 60, 50, 90, 140, 160, 150, 120}, 0.16, 0.90},
    {760, -1, {130, 140, 120, 70, 40, 60, 110, 150, 160, 150}, 0.25, 0.95},
    {560, 1, {30, 40, 80, 140, 170, 150, 100, 60, 40, 50}, 0.04, 0.70},
    {180, 1, {150, 120, 130, 160, 140, 90, 50, 40, 70, 110}, 0.33, 1.00},
}};

std::vector<ControlPoint> control_points(const Script& script) {
  std::vector<ControlPoint> points;
  for (std::size_t i = 0; i < script.y.size(); ++i) {
    const double along = (static_cast<double>(i) - 1) * kSpacing;
    points.push_back({script.x + script.direction * along, script.y[i]});
  }
  return points;
}

/// The frame, at most `death`, at which a target leaves the picture.
int leaves_view(const Path& path, int birth, int death) {
  int frame = birth;
  const auto seen = [](const Kinematics& k) { return k.x > 8 && k.x < kWidth - 8; };
  while (frame < death && seen(path((frame - birth) * kInterval))) ++frame;
  return frame;
}

/// Noise over the frame and as much again below it, for clouds that are flatter than wide.
struct Octave : SmoothNoise {
  Octave(int cell, std::uint64_t octave) : SmoothNoise(kWidth, 2 * kHeight, cell, octave) {}
};

/// Grey levels of the background: a sky that brightens downwards, clouds, rough ground.
struct Landscape {
  Octave large{160, 1}, medium{60, 2}, small{24, 3};
  Octave fields{30, 4}, rough{7, 5}, hills{120, 6}, trees{18, 7};

  double sky(double x, double y) const {
    const double clouds = 5 * large(x, 2 * y) + 2.5 * medium(x, 2 * y) + 1.2 * small(x, y);
    return 94 + 22 * y / kHeight + std::max(clouds, -3.0);
  }
  double ground(double x, double y) const { return 128 + 6 * fields(x, y) + 3 * rough(x, y); }
  double skyline(double x) const { return 222 + 10 * hills(x, 0) + 3 * trees(x, 0); }
};

Image<float> landscape() {
  const Landscape land;
  Image<float> image(kWidth, kHeight);
  const ImageView<float> out = image.view();
  for (int x = 0; x < kWidth; ++x) {
    const double edge = land.skyline(x);
    for (int y = 0; y < kHeight; ++y) {
      const double share = std::clamp(y - edge + 0.5, 0.0, 1.0);  // of ground in the pixel
      out(x, y) = static_cast<float>(std::lerp(land.sky(x, y), land.ground(x, y), share));
    }
  }
  return image;
}

}  // namespace

void describe(FieldList& list, IrClipScene& config) {
  list("frames", config.frames, 10, 100000, "", "length of the clip, at 30 frames/s");
  list("noise", config.noise, 0, 50, "grey levels", "sd of the noise");
  list("snr_low", config.snr_low, -20, 40, "dB", "peak of the dimmest target above the noise");
  list("snr_high", config.snr_high, -20, 40, "dB", "peak of the brightest target above the noise");
  list("speed", config.speed, 0.1, 20, "px/frame", "mean speed of the targets");
  list("sigma", config.sigma, 0.3, 2.6, "px", "of the Gaussian point spread");
}

Scene make_scene(const IrClipScene& config) {
  Scene scene;
  scene.name = IrClipScene::kName;
  scene.width = kWidth;
  scene.height = kHeight;
  scene.frames = config.frames;
  scene.interval = kInterval;
  scene.point_spread = PointSpread::of(config.sigma);
  scene.noise_sigma = config.noise;
  scene.background = landscape();
  scene.grey_levels = true;
  const double frames_per_segment = kSpacing / config.speed;
  for (std::size_t i = 0; i < kScripts.size(); ++i) {
    const Script& script = kScripts[i];
    const double share = static_cast<double>(i) / (kScripts.size() - 1);
    const double snr = std::lerp(config.snr_low, config.snr_high, share);
    const int birth = static_cast<int>(script.birth * config.frames);
    const Path path = fly_spline(control_points(script), 1 / (frames_per_segment * kInterval));
    const int death = leaves_view(path, birth, static_cast<int>(script.death * config.frames));
    scene.targets.push_back(
        {birth, death, config.noise * scene.point_spread.intensity_of_snr(snr), path});
  }
  return scene;
}

}  // namespace glint
