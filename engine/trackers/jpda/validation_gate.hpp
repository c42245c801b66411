// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "glint/engine/trackers/jpda/bank_prediction.hpp"

namespace glint {

/// Tells which points of a scan may be a target's: those near enough to what any of its models
/// expects under any of its hypotheses. P-JPDA (24), (25) take the largest of these gates alone,
/// centred on one hypothesis, and so lose points that another one expects.
template <class Sensor>
class ValidationGate {
 public:
  /// `size`: squared distance in units of the innovation's spread, gamma.
  explicit ValidationGate(double size) : size_(size) {}

  /// A gate for a scan of so many points, with none in it yet.
  void reset(std::size_t points) { inside_.assign(points, false), volume_ = 0; }
  /// Adds the gates of the models of one hypothesis.
  void add(const BankPrediction<Sensor>& expected, std::span<const Measurement<Sensor>> points) {
    for (const auto& any : expected) {
      std::visit(
          [&](const auto& model) {
            volume_ = std::max(volume_, model.gate_volume(size_));
            for (std::size_t i = 0; i < points.size(); ++i) {
              if (model.distance(points[i]) <= size_) inside_[i] = true;
            }
          },
          any);
    }
  }
  bool holds(std::size_t point) const { return inside_[point]; }
  /// Of the largest of the gates, P-JPDA (26), in units of a measurement.
  double volume() const { return volume_; }

 private:
  double size_;
  std::vector<bool> inside_;
  double volume_ = 0;
};

}  // namespace glint
