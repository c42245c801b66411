// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "glint/engine/scenario/scenes.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

constexpr double kMargin = 3;  // [px]

/// What a target's course is drawn by.
struct CourseSettings {
  double size;         // of the frame [px]
  double speed;        // [px/frame]
  double manoeuvre;    // [px^2/frame^2]
  std::uint32_t life;  // [frames]
};

/// A course, frame by frame: constant velocity driven by white noise. Its integral over a frame
/// adds (q / 3, q / 2; q / 2, q) to the covariance of position and velocity.
std::vector<Kinematics> course(const CourseSettings& settings, RandomKey key) {
  const Words4 start = random_words(key, 0);
  const auto share = [&](std::size_t i) { return static_cast<double>(uniform(start.w[i])); };
  const double heading = 2 * std::numbers::pi * share(0);
  const double room = settings.size - 1 - 2 * kMargin;
  Kinematics at{kMargin + room * share(1), kMargin + room * share(2),
                settings.speed * std::cos(heading), settings.speed * std::sin(heading)};
  const double sd = std::sqrt(settings.manoeuvre);
  std::vector<Kinematics> frames;
  for (std::uint32_t k = 0; k < settings.life; ++k) {
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

/// The first course of the series `seed` that stays inside the frame.
std::vector<Kinematics> course_inside(std::string_view scene, const CourseSettings& settings,
                                      std::uint64_t seed) {
  constexpr std::uint32_t kAttempts = 10000;
  for (std::uint32_t attempt = 0; attempt < kAttempts; ++attempt) {
    std::vector<Kinematics> frames = course(settings, random_key(seed, attempt, Purpose::scenario));
    if (inside(frames, settings.size)) return frames;
  }
  throw ConfigError("scenes." + std::string(scene) + ": no course of " +
                    std::to_string(settings.life) +
                    " frames at this speed and manoeuvre stays inside the frame; lower them or "
                    "raise size");
}

Path path_of(std::vector<Kinematics> frames) {
  return [frames = std::move(frames)](double age) {
    const double frame = std::clamp(std::round(age), 0.0, static_cast<double>(frames.size() - 1));
    return frames[static_cast<std::size_t>(frame)];
  };
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
  constexpr int kFirst = 10, kLife = 30;  // [frames]
  Scene scene;
  scene.name = DimTargetScene::kName;
  scene.width = scene.height = config.size;
  scene.frames = 50;
  const CourseSettings settings{static_cast<double>(config.size), config.speed, config.manoeuvre,
                                kLife};
  scene.targets = {
      {kFirst, kFirst + kLife, scene.point_spread.intensity_of_snr(config.snr),
       path_of(course_inside(scene.name, settings, static_cast<std::uint64_t>(config.variant)))}};
  return scene;
}

void describe(FieldList& list, DimFieldScene& config) {
  list("size", config.size, 16, 4096, "px", "width and height of a frame");
  list("targets", config.targets, 0, 100000, "", "how many");
  list("snr_low", config.snr_low, -20, 40, "dB", "of the dimmest target's peak above the noise");
  list("snr_high", config.snr_high, -20, 40, "dB", "of the brightest one's");
  list("speed_low", config.speed_low, 0, 100, "px/frame", "of the slowest target at first");
  list("speed_high", config.speed_high, 0, 100, "px/frame", "of the fastest one");
  list("manoeuvre", config.manoeuvre, 0, 10, "px^2/frame^2",
       "variance that a frame adds to each velocity");
  list("variant", config.variant, 0, 1000000000, "", "other courses");
}

Scene make_scene(const DimFieldScene& config) {
  constexpr int kFirst = 3, kLife = 34;  // [frames]
  if (config.snr_low > config.snr_high || config.speed_low > config.speed_high) {
    throw ConfigError(
        "scenes.dim-field: snr_low and speed_low must not exceed snr_high and speed_high");
  }
  Scene scene;
  scene.name = DimFieldScene::kName;
  scene.width = scene.height = config.size;
  scene.frames = 40;
  for (int i = 0; i < config.targets; ++i) {
    // Targets are told apart by the upper half of the seed: no variant has another's courses.
    const std::uint64_t seed =
        static_cast<std::uint64_t>(config.variant) | (static_cast<std::uint64_t>(i + 1) << 32);
    const Words4 draw = random_words(random_key(seed, 0, Purpose::scenario), 1U << 20);
    const auto between = [&](double low, double high, std::size_t word) {
      return low + (high - low) * static_cast<double>(uniform(draw.w[word]));
    };
    const CourseSettings settings{static_cast<double>(config.size),
                                  between(config.speed_low, config.speed_high, 0), config.manoeuvre,
                                  kLife};
    const double snr = between(config.snr_low, config.snr_high, 1);
    scene.targets.push_back({kFirst, kFirst + kLife, scene.point_spread.intensity_of_snr(snr),
                             path_of(course_inside(scene.name, settings, seed))});
  }
  return scene;
}

}  // namespace glint
