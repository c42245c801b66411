// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/motion_bank.hpp"

#include <algorithm>
#include <numbers>

namespace glint {

bool MotionBank::has_acceleration() const {
  return std::any_of(modes.begin(), modes.end(),
                     [](const MotionMode& m) { return m.motion == Motion::constant_acceleration; });
}

MotionBank motion_bank(const std::string& name, double noise, double turn_rate) {
  const auto q = static_cast<float>(noise), omega = static_cast<float>(turn_rate);
  const MotionMode cv{Motion::constant_velocity, 0, q};
  if (name == "cv") return {{"cv"}, {cv}, {}, {1}};
  if (name == "ca") return {{"ca"}, {{Motion::constant_acceleration, 0, q}}, {}, {1}};
  if (name == "cv+ct") {
    return {{"cv", "ct-", "ct+"},
            {cv, {Motion::coordinated_turn, -omega, q}, {Motion::coordinated_turn, omega, q}},
            {.8f, .1f, .1f, .3f, .6f, .1f, .3f, .1f, .6f},  // P-PHD (39)
            {.8f, .1f, .1f}};                               // P-PHD section 5.2
  }
  throw ConfigError("motion must be cv, ca or cv+ct, got '" + name + "'");
}

MotionBank MotionConfig::bank() const {
  return motion_bank(motion, process_noise, turn_rate * std::numbers::pi / 180);
}

namespace {

/// Left eigenvector of the chain for eigenvalue 1, by iteration: the chains here forget quickly.
std::vector<double> stationary(const MotionBank& bank) {
  const std::size_t n = bank.modes.size();
  std::vector<double> now(n, 1.0 / static_cast<double>(n)), next(n);
  for (int iteration = 0; iteration < 1000; ++iteration) {
    std::fill(next.begin(), next.end(), 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) next[j] += now[i] * bank.switching[i * n + j];
    }
    std::swap(now, next);
  }
  return now;
}

}  // namespace

MotionBank reversed(const MotionBank& bank) {
  MotionBank back = bank;
  for (MotionMode& mode : back.modes) mode.turn_rate = -mode.turn_rate;
  if (bank.switching.empty()) return back;
  const std::size_t n = bank.modes.size();
  const std::vector<double> share = stationary(bank);
  for (std::size_t j = 0; j < n; ++j) {
    double row = 0;
    for (std::size_t i = 0; i < n; ++i) row += share[i] * bank.switching[i * n + j];
    for (std::size_t i = 0; i < n; ++i) {  // Bayes: P(i before | j now)
      const double p = row > 0 ? share[i] * bank.switching[i * n + j] / row : i == j;
      back.switching[j * n + i] = static_cast<float>(p);
    }
  }
  return back;
}

}  // namespace glint
