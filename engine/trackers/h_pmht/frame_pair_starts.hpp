// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <tuple>
#include <vector>

#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/point_spread.hpp"
#include "glint/kernels/core/resident_memory.hpp"
#include "glint/kernels/find_points/find_points.hpp"

namespace glint {

/// A target that two successive frames hint at.
struct FramePairStart {
  double x = 0, y = 0;                ///< in the later frame [px]
  double before_x = 0, before_y = 0;  ///< in the earlier one [px]
  double score = 0;                   ///< sum of the two log likelihood ratios
};

/// All pairs of points at most `reach` [px] apart, by falling score (the sum of the amplitudes);
/// a point comes in as many as it has partners. Points are row by row, as FindPoints has them.
void pair_points(std::span<const Point> before, std::span<const Point> now, double reach,
                 std::vector<FramePairStart>& pairs);

/// Finds new targets: local maxima of the log likelihood ratio of a target of a given brightness,
/// in two successive frames.
class FramePairStarts {
 public:
  /// `intensity` [noise sigmas] of the whole target; maxima below `threshold` do not count.
  FramePairStarts(const PointSpread& spread, double intensity, double threshold,
                  const Device& device)
      : spread_(spread), intensity_(intensity), threshold_(threshold), device_(device) {}

  /// Pairs of this frame with the one of the last call, by falling score. Valid until the next
  /// call. An empty frame has no points.
  std::span<const FramePairStart> find(FrameView whitened, double reach);

  // The next find() takes them for those before.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.now_);
  }
  void restored() const;

 private:
  void find_points(FrameView whitened);

  PointSpread spread_;
  double intensity_, threshold_;
  Device device_;
  ResidentImage<float> ratio_;
  std::vector<Point> before_, now_;
  PointWorkspace workspace_;
  std::vector<FramePairStart> pairs_;
};

}  // namespace glint
