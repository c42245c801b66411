// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <span>
#include <tuple>
#include <vector>

#include <Eigen/Core>

#include "glint/engine/state/bytes.hpp"
#include "glint/engine/tracks/scan_points.hpp"

namespace glint {

/// A point that no track has.
struct FreePoint {
  Eigen::Vector2d position;  ///< [px]
  double amplitude = 0;      ///< [sigma]; finite

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.position, s.amplitude);
  }
  void restored() const {
    require_bytes(position.allFinite() && std::isfinite(amplitude), "a point is nowhere");
  }
};

/// Two points, of one scan and of the next, that may be one new target.
struct TwoPointStart {
  FreePoint before, now;
};

/// Starts tracks from pairs of points.
class TwoPointStarts {
 public:
  /// Of the points that were free at the last call and those that now are, if bright enough or of
  /// unknown amplitude.
  std::span<const TwoPointStart> next(const ScanPoints& points, double least_amplitude,
                                      double reach);
  /// Pairs at most `reach` [px] apart, each point in one pair: the brightest first, of equals the
  /// nearest, then in the order of the points. Valid until the next call.
  std::span<const TwoPointStart> find(std::span<const FreePoint> before,
                                      std::span<const FreePoint> now, double reach);

  // The next() after it takes them for those before.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.free_);
  }

 private:
  struct Candidate {
    double amplitude, distance;
    std::size_t before, now;
  };
  std::vector<FreePoint> free_, free_before_;
  std::vector<Candidate> candidates_;
  std::vector<bool> taken_before_, taken_now_;
  std::vector<TwoPointStart> starts_;
};

}  // namespace glint
