// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "glint/engine/config.hpp"
#include "glint/engine/frames/matched_filter.hpp"
#include "glint/engine/frames/wavelet_filter.hpp"
#include "glint/engine/scan.hpp"
#include "glint/kernels/core/device.hpp"
#include "glint/kernels/find_points/find_points.hpp"

namespace glint {

/// What a point is; docs/points.md says when to take which.
enum class PointDetector {
  matched_filter,  ///< a maximum of MatchedFilter
  wavelet,         ///< a maximum of WaveletFilter
  unit_5x5,        ///< a bright block of the raw frame, P-HPMHT (20)
};

/// How points are found in single frames; the file section [points].
struct PointsConfig {
  PointDetector detector = PointDetector::matched_filter;
  double psf_sigma = 1.0;       ///< [px] of the matched filter
  double wavelet_k = 1.0;       ///< [sigma] of a scale; smaller coefficients of wavelets are none
  double threshold = 2.0;       ///< [sigma] of either filter
  int radius = 4;               ///< [px]; a smaller one lets a target give several points
  double unit_threshold = 1.1;  ///< [mean intensity of the frame]
};
void describe(FieldList& list, PointsConfig& config);

/// Points of single frames, as trackers of points and the single-frame baseline take them.
class PointFinder {
 public:
  PointFinder(const PointsConfig& config, const Device& device);
  /// Replaces `points`, row by row. matched_filter, wavelet: maxima of the filter on `whitened`,
  /// amplitude in sigmas. unit_5x5: blocks of `raw` whose mean exceeds unit_threshold times the
  /// frame's, amplitude in grey levels; none in a scan without `raw`.
  void find(const Scan& scan, std::vector<PointMeasurement>& points);

 private:
  void find_maxima(const Scan& scan);
  void find_units(const Scan& scan);
  double mean(FrameView frame);

  PointsConfig config_;
  Device device_;
  MatchedFilter matched_;
  WaveletFilter wavelet_;
  PointWorkspace workspace_;
  std::vector<Point> found_;
  std::vector<double> row_sums_;
};

}  // namespace glint
