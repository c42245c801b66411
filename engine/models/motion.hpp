// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>

#include <Eigen/Core>

#include "glint/engine/filters/gaussian.hpp"

namespace glint {

/// Motion of a point along each axis of the picture, both alike and independent. The state is
/// [x vx (ax) y vy (ay)]: a model has the first kParts of position, velocity and acceleration.
struct ConstantVelocity {
  static constexpr int kParts = 2;
  double noise = 1;  ///< spectral density of the acceleration [px^2/frame^3]
};
struct ConstantAcceleration {
  static constexpr int kParts = 3;
  double noise = 1;  ///< spectral density of the jerk [px^2/frame^5]
};

template <class Model>
using AxisMatrix = Eigen::Matrix<double, Model::kParts, Model::kParts>;
template <class Model>
using Belief = Gaussian<2 * Model::kParts>;

/// Of one axis, over `step` [frames].
inline Eigen::Matrix2d transition(const ConstantVelocity&, double step) {
  return (Eigen::Matrix2d() << 1, step, 0, 1).finished();
}
inline Eigen::Matrix3d transition(const ConstantAcceleration&, double step) {
  return (Eigen::Matrix3d() << 1, step, step * step / 2, 0, 1, step, 0, 0, 1).finished();
}

/// Covariance that one axis gains over `step` [frames]. P-HPMHT (22) for constant velocity.
inline Eigen::Matrix2d process_noise(const ConstantVelocity& model, double step) {
  const double t2 = step * step / 2, t3 = step * step * step / 3;
  return model.noise * (Eigen::Matrix2d() << t3, t2, t2, step).finished();
}
inline Eigen::Matrix3d process_noise(const ConstantAcceleration& model, double step) {
  const double t2 = step * step, t3 = t2 * step, t4 = t3 * step, t5 = t4 * step;
  return model.noise * (Eigen::Matrix3d() << t5 / 20, t4 / 8, t3 / 6,  //
                        t4 / 8, t3 / 3, t2 / 2,                        //
                        t3 / 6, t2 / 2, step)
                           .finished();
}

/// Kalman prediction over `step` [frames].
template <class Model>
void predict(const Model& model, Belief<Model>& belief, double step) {
  constexpr int kParts = Model::kParts;
  Eigen::Matrix<double, 2 * kParts, 2 * kParts> f, q;
  f.setZero(), q.setZero();
  for (const int at : {0, kParts}) {
    f.template block<kParts, kParts>(at, at) = transition(model, step);
    q.template block<kParts, kParts>(at, at) = process_noise(model, step);
  }
  belief.mean = (f * belief.mean).eval();
  belief.covariance = (f * belief.covariance * f.transpose() + q).eval();
  symmetrise(belief.covariance);
}

/// `from` as a state of another model: parts that it has and `To` lacks are left out; parts that
/// it lacks keep what `own` says of them, so that mixing does not drag them to 0.
template <class To, class From>
Belief<To> embed(const Belief<From>& from, const Belief<To>& own) {
  constexpr int kTo = To::kParts, kFrom = From::kParts, kShared = std::min(kTo, kFrom);
  Belief<To> result = own;
  for (int i = 0; i < 2; ++i) {
    const auto to = Eigen::seqN(i * kTo, kShared), source = Eigen::seqN(i * kFrom, kShared);
    result.covariance(to, Eigen::all).setZero();
    result.covariance(Eigen::all, to).setZero();
    result.mean(to) = from.mean(source);
  }
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      result.covariance(Eigen::seqN(i * kTo, kShared), Eigen::seqN(j * kTo, kShared)) =
          from.covariance(Eigen::seqN(i * kFrom, kShared), Eigen::seqN(j * kFrom, kShared));
    }
  }
  return result;
}

}  // namespace glint
