// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "glint/kernels/core/aligned.hpp"

namespace glint {

/// Particles as structure of arrays; all arrays have the same length. Units: [px], [px/step],
/// [px/step^2], intensity in noise sigmas, weight in expected targets. A step is whatever unit of
/// time Propagate's `step` counts; the engine counts frames.
struct Particles {
  AlignedVector<float> x, y, vx, vy, ax, ay, intensity, weight;
  AlignedVector<std::uint32_t> mode;   ///< index of the motion model
  AlignedVector<std::uint32_t> label;  ///< track that the particle belongs to; 0 = none yet

  std::size_t size() const { return x.size(); }
  void resize(std::size_t n) {
    for_each_array([n](auto& a) { a.resize(n); });
  }
  void reserve(std::size_t n) {
    for_each_array([n](auto& a) { a.reserve(n); });
  }
  /// All arrays.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.x, s.y, s.vx, s.vy, s.ax, s.ay, s.intensity, s.weight, s.mode, s.label);
  }
  template <class F>
  void for_each_array(F&& f) {
    std::apply([&](auto&... array) { (f(array), ...); }, fields(*this));
  }
  template <class F>
  void for_each_array(F&& f) const {
    std::apply([&](const auto&... array) { (f(array), ...); }, fields(*this));
  }
};

}  // namespace glint
