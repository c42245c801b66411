// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string_view>
#include <vector>

#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/trial.hpp"

namespace glint {

/// A point detection, sub-pixel.
struct Point {
  float x, y;       ///< [px]
  float amplitude;  ///< value of the map there
  bool operator==(const Point&) const = default;
};

/// Points of a map: pixels above the threshold that are the maximum of their neighbourhood, with a
/// parabola through the neighbours for the sub-pixel centre; or blocks of 5x5 pixels whose mean
/// exceeds the threshold, with their intensity centroid. P-HPMHT (20).
struct FindPoints {
  static constexpr std::string_view name = "find_points";
  static constexpr Tolerance tolerance{1e-4, 1e-5};

  enum class Mode { local_maximum, unit_5x5 };
  struct Args {
    FrameView map;
    Mode mode = Mode::local_maximum;
    float threshold = 0;
    int radius = 1;  ///< of the neighbourhood [px], local maxima only; of equal values the first in
                     ///< row order wins. NaN pixels are no points and beat nobody.
    std::vector<Point>* points = nullptr;  ///< replaced; row by row, left to right
  };
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static std::vector<std::unique_ptr<Trial>> trials();
};

}  // namespace glint
