// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <tuple>

#include "glint/engine/filters/gaussian.hpp"
#include "glint/engine/filters/singer.hpp"

namespace glint {

// Motion of a point along 2 or 3 axes. The state is [x vx (ax) y vy (ay) (z vz (az))]: a model has
// the first kParts of position, velocity and acceleration of every axis. Lengths are in px or m,
// times in frames or s, the same throughout: only the steps say which.

/// White acceleration.
struct ConstantVelocity {
  static constexpr int kParts = 2;
  double noise = 1;  ///< spectral density of the acceleration [length^2/time^3]
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.noise);
  }
};
/// White jerk.
struct ConstantAcceleration {
  static constexpr int kParts = 3;
  double noise = 1;  ///< spectral density of the jerk [length^2/time^5]
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.noise);
  }
};
/// Acceleration that is drawn anew for every step and constant within it (NCV). Two half steps are
/// less noisy than a whole one.
struct NearlyConstantVelocity {
  static constexpr int kParts = 2;
  double variance = 1;  ///< of the acceleration [length^2/time^4]
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.variance);
  }
};
/// Acceleration that jumps at every step and is constant within it (WPA); the CA of P-PMHT.
struct WienerAcceleration {
  static constexpr int kParts = 3;
  double variance = 1;  ///< of a step's jump of the acceleration [length^2/time^4]
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.variance);
  }
};
/// Turn in the plane of x and y at a known rate, with white acceleration; along z at constant
/// velocity. A positive rate turns x towards y: to the left where y points up, to the right in a
/// picture, where y points down, as in the kernel Propagate.
struct CoordinatedTurn {
  static constexpr int kParts = 2;
  double rate = 0;   ///< [rad/time]
  double noise = 1;  ///< spectral density of the acceleration [length^2/time^3]
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.rate, s.noise);
  }
};

template <class Model, int Axes = 2>
using Belief = Gaussian<Axes * Model::kParts>;

/// Of one axis, over `step`; likewise for Singer.
Eigen::Matrix2d transition(const ConstantVelocity&, double step);
Eigen::Matrix3d transition(const ConstantAcceleration&, double step);
Eigen::Matrix2d transition(const NearlyConstantVelocity&, double step);
Eigen::Matrix3d transition(const WienerAcceleration&, double step);
/// Covariance that one axis gains over `step`. P-HPMHT (22) for constant velocity.
Eigen::Matrix2d process_noise(const ConstantVelocity& model, double step);
Eigen::Matrix3d process_noise(const ConstantAcceleration& model, double step);
/// variance G G' with G = [step^2/2 step (1)]: of rank 1.
Eigen::Matrix2d process_noise(const NearlyConstantVelocity& model, double step);
Eigen::Matrix3d process_noise(const WienerAcceleration& model, double step);
/// Of x and y together.
Eigen::Matrix4d transition(const CoordinatedTurn& model, double step);

/// x' = F x + w with w of covariance Q, all axes together.
template <int N>
struct LinearMotion {
  Eigen::Matrix<double, N, N> transition = Eigen::Matrix<double, N, N>::Zero();  ///< F
  Eigen::Matrix<double, N, N> noise = Eigen::Matrix<double, N, N>::Zero();       ///< Q
};

template <int Axes, class Model>
LinearMotion<Axes * Model::kParts> linear_motion(const Model& model, double step) {
  constexpr int kParts = Model::kParts;
  LinearMotion<Axes * kParts> motion;
  for (int at = 0; at < Axes * kParts; at += kParts) {
    motion.transition.template block<kParts, kParts>(at, at) = transition(model, step);
    motion.noise.template block<kParts, kParts>(at, at) = process_noise(model, step);
  }
  return motion;
}
template <int Axes>
LinearMotion<2 * Axes> linear_motion(const CoordinatedTurn& model, double step) {
  LinearMotion<2 * Axes> motion = linear_motion<Axes>(ConstantVelocity{model.noise}, step);
  motion.transition.template topLeftCorner<4, 4>() = transition(model, step);
  return motion;
}

/// Kalman prediction.
template <int N>
void predict(const LinearMotion<N>& motion, Gaussian<N>& belief) {
  const auto& f = motion.transition;
  belief.mean = (f * belief.mean).eval();
  belief.covariance = (f * belief.covariance * f.transpose() + motion.noise).eval();
  symmetrise(belief.covariance);
}
template <class Model, int N>
void predict(const Model& model, Gaussian<N>& belief, double step) {
  predict(linear_motion<N / Model::kParts>(model, step), belief);
}

/// `from` as the state of a model with other parts (N and M numbers, of as many axes): parts that
/// it has and that model lacks are left out; parts that it lacks keep what `own` says of them, so
/// that mixing does not drag them to 0.
template <int Axes, int N, int M>
Gaussian<N> embed(const Gaussian<M>& from, const Gaussian<N>& own) {
  constexpr int kTo = N / Axes, kFrom = M / Axes, kShared = kTo < kFrom ? kTo : kFrom;
  Gaussian<N> result = own;
  for (int i = 0; i < Axes; ++i) {
    const auto to = Eigen::seqN(i * kTo, kShared), source = Eigen::seqN(i * kFrom, kShared);
    result.covariance(to, Eigen::all).setZero();
    result.covariance(Eigen::all, to).setZero();
    result.mean(to) = from.mean(source);
  }
  for (int i = 0; i < Axes; ++i) {
    for (int j = 0; j < Axes; ++j) {
      result.covariance(Eigen::seqN(i * kTo, kShared), Eigen::seqN(j * kTo, kShared)) =
          from.covariance(Eigen::seqN(i * kFrom, kShared), Eigen::seqN(j * kFrom, kShared));
    }
  }
  return result;
}

}  // namespace glint
