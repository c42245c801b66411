// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "glint/engine/trackers/phd/peaks.hpp"
#include "glint/kernels/core/particles.hpp"

namespace glint {

/// Process noise Q of each target: more as its particles contract, less as they spread. P-PHD (21),
/// with the determinant of the position covariance; a target is known by its particles' label. The
/// formula acts like a switch between Qmin and Qmax.
class AdaptiveNoise {
 public:
  /// `range` is Qmax / Qmin >= 1; 1 keeps Q at Qmin.
  explicit AdaptiveNoise(double range) : range_(range) {}

  /// Updates Q from the clusters of this frame; `particles.label` holds the label of each cluster's
  /// members. Labels without a cluster are removed, new ones start at Qmin; a singular covariance
  /// leaves Q as it is.
  void update(std::span<const Peak> clusters, std::span<const std::uint32_t> members,
              const Particles& particles);
  bool fixed() const { return range_ <= 1; }
  /// sqrt(Q / Qmin) of each particle by its label; empty if Q is fixed. Valid until the next call.
  std::span<const float> scales(std::span<const std::uint32_t> labels);

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.targets_);
  }

 private:
  struct Target {
    std::uint32_t label;
    double noise, determinant;  // Q / Qmin; of P_k [px^4]
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.label, s.noise, s.determinant);
    }
  };
  const Target* find(std::uint32_t label) const;

  double range_;
  std::vector<Target> targets_, next_;  // by rising label
  std::vector<float> scales_;
};

}  // namespace glint
