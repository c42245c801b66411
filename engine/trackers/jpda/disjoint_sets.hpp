// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace glint {

/// Sets of numbers that are joined two by two (union-find with path halving). A set's root is its
/// least number, whatever the order of the calls.
class DisjointSets {
 public:
  /// Of the numbers below `count`, each alone.
  void reset(std::size_t count) {
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  /// Makes the number a set of its own; all numbers of its former set must be isolated before the
  /// next call of another function.
  void isolate(std::uint32_t number) { parent_[number] = number; }
  std::uint32_t root(std::uint32_t number) {
    while (parent_[number] != number) number = parent_[number] = parent_[parent_[number]];
    return number;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace glint
