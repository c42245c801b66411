// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <tuple>

#include "glint/engine/filters/imm.hpp"
#include "glint/engine/trackers/pmht/pmht_em.hpp"

namespace glint {

/// A target's motion models as PMHT moves them: a Kalman filter each, mixed as an IMM. P-PMHT
/// section 3.
class KalmanBank {
 public:
  /// To be restored.
  KalmanBank() = default;
  /// `variance`: of a point's position along each axis [px^2].
  KalmanBank(Imm imm, double variance) : imm_(std::move(imm)), variance_(variance) {}

  void predict(double step) { imm_.mix(), imm_.predict(step); }
  /// Where a model expects the target.
  PmhtMode mode(std::size_t model) const;
  /// Where it has it given the centroid.
  Eigen::Vector2d maximise(std::size_t model, const PmhtCentroid& centroid) const;
  /// Takes the scan in: states by the last centroids, one a model, probabilities by the first.
  void update(std::span<const PmhtCentroid> first, std::span<const PmhtCentroid> last);

  Gaussian<4> state() const { return imm_.combined(); }
  const ModeProbability& probability() const { return imm_.probability(); }
  /// Is made of the same models.
  bool alike(const KalmanBank& other) const { return imm_.alike(other.imm_); }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.imm_, s.variance_);
  }

 private:
  Imm imm_;
  double variance_ = 1;
};

}  // namespace glint
