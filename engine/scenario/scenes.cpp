// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/scenario/scenes.hpp"

#include <array>
#include <string>

#include "glint/engine/scenario/radar_scenes.hpp"
#include "glint/engine/scenario/scene_entry.hpp"

namespace glint {
namespace {

template <class C>
constexpr SceneEntry entry(std::string_view summary) {
  return scene_entry<SceneEntry, C>(summary);
}

constexpr std::array kScenes{
    entry<PhdScene>("one dim target in white noise: P-PHD section 5.1"),
    entry<PhdManoeuvreScene>("three dim targets, two of them turning: P-PHD section 5.2"),
    entry<PhdArcsScene>("three dim targets on arcs, a frame every 2 s: P-PHD section 5.3"),
    entry<IrClipScene>("infrared-like clip, six dim targets over clouds and ground"),
    entry<AircraftScene>("a dark aircraft before a cloudy sky: P-HPMHT section 4"),
    entry<PmhtClipScene>("fast point targets on splines and turns: P-PMHT section 4"),
    entry<DimTargetScene>("one dim target on a course of its own for each variant"),
    entry<DimFieldScene>("two hundred targets of 6 to 14 dB in 512x512 pixels"),
    entry<CrossingScene>("two targets that cross"),
    entry<NoiseScene>("white noise alone"),
};

}  // namespace

void describe(FieldList& list, NoiseScene& config) {
  list("width", config.width, 1, 32768, "px", "width of a frame");
  list("height", config.height, 1, 32768, "px", "height of a frame");
  list("frames", config.frames, 1, 1000000, "", "length of the sequence");
  list("noise", config.noise, 0, 1e6, "", "sd of the noise");
}

Scene make_scene(const NoiseScene& config) {
  Scene scene;
  scene.name = NoiseScene::kName;
  scene.width = config.width;
  scene.height = config.height;
  scene.frames = config.frames;
  scene.noise_sigma = config.noise;
  return scene;
}

void describe(FieldList& list, CrossingScene& config) {
  list("snr", config.snr, -20, 40, "dB", "peak of a target's image above the noise");
  list("frames", config.frames, 2, 1000, "", "length of the sequence");
}

Scene make_scene(const CrossingScene& config) {
  Scene scene;
  scene.name = CrossingScene::kName;
  scene.width = scene.height = 64;
  scene.frames = config.frames;
  const double intensity = scene.point_spread.intensity_of_snr(config.snr);
  const double speed = 48.0 / (config.frames - 1);
  scene.targets = {{0, config.frames, intensity, fly({8, 20, speed, speed / 2})},
                   {0, config.frames, intensity, fly({8, 44, speed, -speed / 2})}};
  return scene;
}

std::span<const SceneEntry> all_scenes() { return kScenes; }

const SceneEntry& find_scene(std::string_view name) {
  std::string known;
  for (const SceneEntry& scene : kScenes) {
    if (scene.name == name) return scene;
    known += (known.empty() ? "" : ", ") + std::string(scene.name);
  }
  const std::string given(name);
  if (find_radar_scene(name) != nullptr) {
    throw ConfigError("scene '" + given +
                      "' is points of a radar, without frames: glint simulate " + given +
                      " --out DIR writes them, glint track DIR/points.csv follows them");
  }
  for (const RadarSceneEntry& scene : all_radar_scenes()) known += ", " + std::string(scene.name);
  throw ConfigError("there is no scene '" + given + "'; choose one of " + known);
}

}  // namespace glint
