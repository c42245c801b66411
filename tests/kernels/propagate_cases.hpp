// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gtest/gtest.h>

#include <span>

#include "glint/kernels/core/particles.hpp"
#include "glint/kernels/propagate/propagate.hpp"

namespace glint::test {

inline constexpr std::size_t kSamples = 60000;
inline constexpr MotionMode kVelocity{Motion::constant_velocity, 0, 0};
inline constexpr MotionMode kAcceleration{Motion::constant_acceleration, 0, 0};

inline MotionMode turn(double rate) {
  return {Motion::coordinated_turn, static_cast<float>(rate), 0};
}

inline Particles same(std::size_t n) {
  Particles p;
  p.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    p.x[i] = 100, p.y[i] = 50, p.vx[i] = 3, p.vy[i] = -4, p.ax[i] = 0.5f, p.ay[i] = 0.25f;
    p.intensity[i] = 10, p.mode[i] = 0, p.weight[i] = 1;
  }
  return p;
}

inline Propagate::Args args_of(Particles& p, std::span<const MotionMode> modes) {
  return {.x = p.x,
          .y = p.y,
          .vx = p.vx,
          .vy = p.vy,
          .intensity = p.intensity,
          .ax = p.ax,
          .ay = p.ay,
          .mode = p.mode,
          .modes = modes,
          .switching = {},
          .intensity_low = 8,
          .intensity_high = 12,
          .seed = 42,
          .frame = 3};
}

class PropagateOn : public testing::TestWithParam<DeviceKind> {
 protected:
  Device device_ = GetParam() == DeviceKind::serial ? Device::serial() : Device::tbb(2);
};

}  // namespace glint::test
