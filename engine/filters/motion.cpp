// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/filters/motion.hpp"

#include <cmath>

namespace glint {

Eigen::Matrix2d transition(const ConstantVelocity&, double step) {
  return (Eigen::Matrix2d() << 1, step, 0, 1).finished();
}

Eigen::Matrix3d transition(const ConstantAcceleration&, double step) {
  return (Eigen::Matrix3d() << 1, step, step * step / 2, 0, 1, step, 0, 0, 1).finished();
}

Eigen::Matrix2d transition(const NearlyConstantVelocity&, double step) {
  return transition(ConstantVelocity{}, step);
}

Eigen::Matrix3d transition(const WienerAcceleration&, double step) {
  return transition(ConstantAcceleration{}, step);
}

/// (1 - cos a) / a is 2 sin^2(a/2) / a, which loses no digits for small a.
Eigen::Matrix4d transition(const CoordinatedTurn& model, double step) {
  const double angle = model.rate * step, half = std::sin(angle / 2);
  const double along = angle == 0 ? step : std::sin(angle) / model.rate;
  const double across = angle == 0 ? 0 : 2 * half * half / model.rate;
  const double c = std::cos(angle), s = std::sin(angle);
  return (Eigen::Matrix4d() << 1, along, 0, -across,  //
          0, c, 0, -s,                                //
          0, across, 1, along,                        //
          0, s, 0, c)
      .finished();
}

Eigen::Matrix2d process_noise(const ConstantVelocity& model, double step) {
  const double t2 = step * step / 2, t3 = step * step * step / 3;
  return model.noise * (Eigen::Matrix2d() << t3, t2, t2, step).finished();
}

Eigen::Matrix3d process_noise(const ConstantAcceleration& model, double step) {
  const double t2 = step * step, t3 = t2 * step, t4 = t3 * step, t5 = t4 * step;
  return model.noise * (Eigen::Matrix3d() << t5 / 20, t4 / 8, t3 / 6,  //
                        t4 / 8, t3 / 3, t2 / 2,                        //
                        t3 / 6, t2 / 2, step)
                           .finished();
}

Eigen::Matrix2d process_noise(const NearlyConstantVelocity& model, double step) {
  const Eigen::Vector2d g(step * step / 2, step);
  return model.variance * g * g.transpose();
}

Eigen::Matrix3d process_noise(const WienerAcceleration& model, double step) {
  const Eigen::Vector3d g(step * step / 2, step, 1);
  return model.variance * g * g.transpose();
}

}  // namespace glint
