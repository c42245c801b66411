// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <stdexcept>

namespace glint {

/// Probabilities of a track's motion models: a short list that allocates nothing.
class ModeProbability {
 public:
  static constexpr std::size_t kCapacity = 8;

  ModeProbability() = default;
  ModeProbability(std::initializer_list<double> values) {
    for (const double p : values) push_back(p);
  }
  /// Throws std::length_error beyond kCapacity, like resize().
  void push_back(double p) {
    resize(size_ + 1);
    values_[size_ - 1] = p;
  }
  void resize(std::size_t size) {
    if (size > kCapacity) throw std::length_error("a track has at most 8 motion models");
    if (size > size_) std::fill(values_.begin() + size_, values_.begin() + size, 0.0);
    size_ = size;
  }
  void clear() { size_ = 0; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  double& operator[](std::size_t i) { return values_[i]; }
  double operator[](std::size_t i) const { return values_[i]; }
  double* begin() { return values_.data(); }
  double* end() { return values_.data() + size_; }
  const double* begin() const { return values_.data(); }
  const double* end() const { return values_.data() + size_; }

 private:
  std::array<double, kCapacity> values_{};
  std::size_t size_ = 0;
};

}  // namespace glint
