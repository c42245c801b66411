// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/endless_points.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "glint/kernels/core/random.hpp"

namespace glint::bench {
namespace {

constexpr int kTargets = 40;
constexpr std::uint64_t kSeed = 1;

// A sine of so much reach [px] and peak speed [px/frame] about `centre`.
struct Wave {
  double centre, reach, speed, phase;
  double at(double age) const { return centre + reach * std::sin(speed / reach * age + phase); }
  double rate(double age) const { return speed * std::cos(speed / reach * age + phase); }
};

Path wave_path(std::uint32_t target) {
  const RandomKey key = random_key(kSeed, 0, Purpose::scenario);
  const auto draw = [&](std::uint32_t i, double low, double high) {
    return low + (high - low) * static_cast<double>(uniform(random_words(key, target, i).w[0]));
  };
  constexpr double kTurn = 2 * std::numbers::pi;
  const Wave x{512, draw(0, 300, 480), draw(1, 3, 6), draw(2, 0, kTurn)};
  const Wave y{128, draw(3, 60, 115), draw(4, 1, 3), draw(5, 0, kTurn)};
  return [=](double age) { return Kinematics{x.at(age), y.at(age), x.rate(age), y.rate(age)}; };
}

}  // namespace

EndlessPoints::EndlessPoints(std::int64_t count, double percent) : count_(count) {
  scene_.width = 1024, scene_.height = 256;
  for (std::uint32_t i = 0; i < kTargets; ++i) {
    scene_.targets.push_back({0, std::numeric_limits<int>::max(), 0, wave_path(i)});
  }
  sensor_.clutter = PointSensor::clutter_of(scene_, percent);
}

std::vector<Kinematics> EndlessPoints::starts() const {
  std::vector<Kinematics> starts;
  for (const ScriptedTarget& target : scene_.targets) starts.push_back(target.path(0));
  return starts;
}

std::optional<SourceFrame> EndlessPoints::next() {
  if (at_ == count_) return std::nullopt;
  SourceFrame frame;
  frame.points = points_at(scene_, sensor_, kSeed, static_cast<int>(at_));
  frame.time = static_cast<double>(at_++);
  return frame;
}

}  // namespace glint::bench
