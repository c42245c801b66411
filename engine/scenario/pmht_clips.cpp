// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include "glint/engine/scenario/scenes.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

using Spline = std::vector<ControlPoint>;

/// Two targets on B-splines over all frames of a clip. The paper prints no paths: these are ours,
/// of its size, speed and shape.
struct SplineClip {
  int frames;
  Spline first, second;
};

SplineClip bs44() {
  return {57,
          {{-90, 60},
           {60, 70},
           {210, 120},
           {370, 170},
           {530, 140},
           {690, 70},
           {830, 80},
           {960, 170},
           {1090, 200}},
          {{-90, 150},
           {60, 135},
           {210, 120},
           {370, 80},
           {530, 110},
           {690, 190},
           {830, 170},
           {960, 80},
           {1090, 60}}};
}

SplineClip bs49() {
  return {
      49,
      {{-70, 20}, {70, 50}, {230, 190}, {390, 230}, {540, 110}, {690, 30}, {840, 150}, {990, 230}},
      {{-70, 240}, {70, 210}, {230, 60}, {390, 30}, {540, 150}, {690, 230}, {840, 100}, {990, 30}}};
}

SplineClip bs50() {
  return {
      44,
      {{1040, 60}, {900, 50}, {760, 130}, {680, 230}, {560, 210}, {420, 60}, {290, 40}, {160, 150}},
      {{1030, 200},
       {890, 220},
       {760, 140},
       {650, 40},
       {520, 60},
       {400, 200},
       {270, 220},
       {130, 120}}};
}

/// Flown so that the last frame is the spline's end.
ScriptedTarget on_spline(Spline control, int frames) {
  const double pace = static_cast<double>(control.size() - 3) / (frames - 1);
  return {0, frames, 0, fly_spline(std::move(control), pace)};
}

Path accelerate(const Kinematics& start, double ax, double ay) {
  return [=](double t) {
    return Kinematics{start.x + start.vx * t + ax * t * t / 2,
                      start.y + start.vy * t + ay * t * t / 2, start.vx + ax * t,
                      start.vy + ay * t};
  };
}

/// P-PMHT section 4: straight to frame 15, 15 deg/frame to 27, -15 from 35 to 47, 12 from 57 to 68,
/// then an acceleration.
Path mixed_path() {
  constexpr double kDegree = std::numbers::pi / 180, kEnd = 68;
  const Path turns =
      fly({30, 30, 10, 1},
          {{15, 0}, {12, 15 * kDegree}, {8, 0}, {12, -15 * kDegree}, {10, 0}, {11, 12 * kDegree}});
  const Path end = accelerate(turns(kEnd), 0.02, 0.02);
  return [=](double t) { return t < kEnd ? turns(t) : end(t - kEnd); };
}

/// Forty targets that cross the picture on gentle splines, drawn anew for each variant.
std::vector<ScriptedTarget> crowd(int variant, int frames) {
  constexpr int kTargets = 40, kSegments = 6;
  const RandomKey key = random_key(static_cast<std::uint64_t>(variant), 0, Purpose::scenario);
  std::vector<ScriptedTarget> targets;
  for (std::uint32_t id = 0; id < kTargets; ++id) {
    const auto draw = [&](std::uint32_t i, double low, double high) {
      return low + (high - low) * static_cast<double>(uniform(random_words(key, id, i).w[0]));
    };
    const double direction = draw(0, -1, 1) < 0 ? -1 : 1, step = draw(1, 40, 80);
    const double length = step * (kSegments + 2);
    double x = 512 + direction * (draw(2, -500, 500 - length)), y = draw(3, 30, 226);
    Spline control;
    for (std::uint32_t i = 0; i < kSegments + 3; ++i) {
      control.push_back({x, y});
      x += direction * step;
      y = std::clamp(y + draw(4 + i, -25, 25), 20.0, 236.0);
    }
    targets.push_back(on_spline(std::move(control), frames));
  }
  return targets;
}

}  // namespace

void describe(FieldList& list, PmhtClipScene& config) {
  list("clip", config.clip, {"bs44", "bs49", "bs50", "monte-carlo", "crowd"},
       "two targets on splines; the paper's three Monte Carlo paths; forty targets");
  list("snr", config.snr, -20, 60, "dB", "peak of a target's image above the noise");
  list("variant", config.variant, 0, 1000000, "", "other paths, of the crowd");
}

Scene make_scene(const PmhtClipScene& config) {
  Scene scene;
  scene.name = PmhtClipScene::kName;
  scene.width = 1024, scene.height = 256;
  if (config.clip == "monte-carlo") {
    scene.frames = 70;
    scene.targets = {{0, 22, 0, accelerate({70, 70, 20, 3}, 0.5, 0.5)},
                     {0, 30, 0, fly({70, 200, 20, -3})},
                     {0, 70, 0, mixed_path()}};
  } else if (config.clip == "crowd") {
    scene.frames = 61;
    scene.targets = crowd(config.variant, scene.frames);
  } else {
    SplineClip clip = config.clip == "bs44" ? bs44() : config.clip == "bs49" ? bs49() : bs50();
    scene.frames = clip.frames;
    scene.targets = {on_spline(std::move(clip.first), clip.frames),
                     on_spline(std::move(clip.second), clip.frames)};
  }
  for (ScriptedTarget& target : scene.targets) {
    target.intensity = scene.point_spread.intensity_of_snr(config.snr);
  }
  return scene;
}

}  // namespace glint
