// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/propagate/propagate.hpp"

namespace glint::propagate {

/// F and the Cholesky factor of Q of one mode over one step. Per axis, with the noises n:
/// x' = x + along v -+ across v_other + half a + xx n0,
/// v' = cosine v -+ sine v_other + time a + vx n0 + vv n1,
/// a' = a + ax n0 + av n1 + aa n2 (upper sign for x).
template <class T>
struct Move {
  T along, across, cosine, sine, xx, vx, vv;  ///< kPlainTerms; CV and turns have no others
  T half, time, ax, av, aa;
};
inline constexpr int kPlainTerms = 7, kTerms = 12;

/// A bank of modes over one step.
template <class T>
struct Transition {
  static constexpr std::size_t kMax = Propagate::kMaxModes;
  int modes = 1;
  bool accelerates = false;  ///< some mode is CA
  Move<T> move[kMax];
  /// [from][to]: probability of a new mode <= to; float everywhere, so that all devices switch
  /// alike.
  float cumulative[kMax][kMax];
  T intensity_deviation = 0;
};

/// Checks the arguments as Propagate says.
void check(const Propagate::Args& args);
/// Of checked arguments.
Transition<double> transition_of(const Propagate::Args& args);
/// The same for devices that calculate in float.
Transition<float> narrowed(const Transition<double>& wide);

}  // namespace glint::propagate
