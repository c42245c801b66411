// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>

#include "glint/engine/cue.hpp"
#include "glint/engine/point_measurement.hpp"
#include "glint/kernels/core/frame.hpp"

namespace glint {

/// One step of the input as every tracker sees it. Immutable; the frames are shared, not copied.
struct Scan {
  std::int64_t frame = 0;  ///< index from 0
  double time = 0;         ///< [s]
  Frame raw;               ///< grey, as delivered (after colour conversion); may be empty
  Frame whitened;  ///< z = polarity (I - background) / sigma, unit noise; masked pixels are 0
  double noise_sigma = 1;             ///< median of the noise map [grey levels]
  double sensor_x = 0, sensor_y = 0;  ///< where it stands, for points of range and azimuth [px]
  std::span<const PointMeasurement>
      points;                 ///< of this frame; only if some tracker feeds on points
  bool looked = true;         ///< false: the sensor of points did not look, which is no miss
  std::span<const Cue> cues;  ///< targets that are said to be here: a track starts on each
};

}  // namespace glint
