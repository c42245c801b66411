// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "glint/engine/scenario/scenes.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

constexpr int kFirst = 10, kLife = 30;  // [frames]
constexpr double kMargin = 3;           // [px]

/// A course, frame by frame: constant velocity driven by white noise. Its integral over a frame
/// adds (q / 3, q / 2; q / 2, q) to the covariance of position and velocity.
std::vector<Kinematics> course(const DimTargetScene& config, std::uint32_t attempt) {
  const RandomKey key =
      random_key(static_cast<std::uint64_t>(config.variant), attempt, Purpose::scenario);
  const Words4 start = random_words(key, 0);
  const auto share = [&](std::size_t i) { return static_cast<double>(uniform(start.w[i])); };
  const double heading = 2 * std::numbers::pi * share(0);
  const double room = config.size - 1 - 2 * kMargin;
  Kinematics at{kMargin + room * share(1), kMargin + room * share(2),
                config.speed * std::cos(heading), config.speed * std::sin(heading)};
  const double sd = std::sqrt(config.manoeuvre);
  std::vector<Kinematics> frames;
  for (std::uint32_t k = 0; k < kLife; ++k) {
    frames.push_back(at);
    const Normals4 n = random_normals(key, k + 1);
    const double vx = sd * static_cast<double>(n.n[0]), vy = sd * static_cast<double>(n.n[1]);
    constexpr double kOwn =
        0.28867513459481287;  // sqrt(1 / 12): what the velocity does not explain
    at.x += at.vx + vx / 2 + kOwn * sd * static_cast<double>(n.n[2]);
    at.y += at.vy + vy / 2 + kOwn * sd * static_cast<double>(n.n[3]);
    at.vx += vx, at.vy += vy;
  }
  return frames;
}

bool inside(const std::vector<Kinematics>& frames, double size) {
  const double last = size - 1 - kMargin;
  return std::ranges::all_of(frames, [&](const Kinematics& at) {
    return at.x > kMargin && at.x < last && at.y > kMargin && at.y < last;
  });
}

std::vector<Kinematics> course_inside(const DimTargetScene& config) {
  constexpr std::uint32_t kAttempts = 10000;
  for (std::uint32_t attempt = 0; attempt < kAttempts; ++attempt) {
    std::vector<Kinematics> frames = course(config, attempt);
    if (inside(frames, config.size)) return frames;
  }
  throw ConfigError(
      "scenes.dim-target: no course of 30 frames at this speed and manoeuvre stays inside the "
      "frame; "
      "lower them or raise size");
}

}  // namespace

void describe(FieldList& list, DimTargetScene& config) {
  list("size", config.size, 16, 4096, "px", "width and height of a frame");
  list("snr", config.snr, -20, 40, "dB", "peak of the target's image above the noise");
  list("speed", config.speed, 0, 100, "px/frame", "of the target at first");
  list("manoeuvre", config.manoeuvre, 0, 10, "px^2/frame^2",
       "variance that a frame adds to each velocity");
  list("variant", config.variant, 0, 1000000000, "", "other courses");
}

Scene make_scene(const DimTargetScene& config) {
  Scene scene;
  scene.name = DimTargetScene::kName;
  scene.width = scene.height = config.size;
  scene.frames = 50;
  std::vector<Kinematics> frames = course_inside(config);
  scene.targets = {{kFirst, kFirst + kLife, scene.point_spread.intensity_of_snr(config.snr),
                    [frames = std::move(frames)](double age) {
                      const double frame = std::clamp(std::round(age), 0.0, kLife - 1.0);
                      return frames[static_cast<std::size_t>(frame)];
                    }}};
  return scene;
}

}  // namespace glint
