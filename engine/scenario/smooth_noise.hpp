// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <cstdint>
#include <vector>

#include "glint/kernels/core/random.hpp"

namespace glint {

/// Smooth noise over 0 <= x <= width, 0 <= y <= height: standard normals on a lattice, joined by
/// cubic steps. A pure function of its arguments.
class SmoothNoise {
 public:
  /// `cell` [px] from node to node; `seed` tells one noise from another.
  SmoothNoise(int width, int height, int cell, std::uint64_t seed)
      : cell_(cell), columns_(width / cell + 2) {
    const int nodes = columns_ * (height / cell + 2);
    const RandomKey key = random_key(seed, 0, Purpose::scenario);
    for (int i = 0; i < nodes; ++i) {
      nodes_.push_back(random_normals(key, static_cast<std::uint32_t>(i)).n[0]);
    }
  }
  double operator()(double x, double y) const {
    const double i = std::floor(x / cell_), j = std::floor(y / cell_);
    const double u = x / cell_ - i, v = y / cell_ - j;
    const double across = u * u * (3 - 2 * u), down = v * v * (3 - 2 * v);
    const double* node = &nodes_[static_cast<std::size_t>(j * columns_ + i)];
    return std::lerp(std::lerp(node[0], node[1], across),
                     std::lerp(node[columns_], node[columns_ + 1], across), down);
  }

 private:
  int cell_, columns_;
  std::vector<double> nodes_;
};

}  // namespace glint
