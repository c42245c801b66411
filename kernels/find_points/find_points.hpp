// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <string_view>
#include <tuple>
#include <vector>

#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/trial.hpp"

namespace glint {

/// A point detection, sub-pixel.
struct Point {
  float x, y;       ///< [px]
  float amplitude;  ///< value of the map there
  bool operator==(const Point&) const = default;
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.x, s.y, s.amplitude);
  }
};

/// Memory that find_points keeps from call to call, so that a warm call allocates nothing.
struct PointWorkspace {
  struct Tile {
    std::vector<std::int32_t> scratch;  ///< columns of the rows at hand
    std::vector<Point> points;
  };
  std::vector<Tile> tiles;
};

/// Points of a map, where they are and how bright; the map is read once, and needs no margin.
///
/// local_maximum: pixels above the threshold that no pixel of the (2 radius + 1)^2 neighbourhood
/// beats; the neighbourhood is clipped at the border. Along each axis the centre is the vertex of
/// the parabola through the pixel and its two neighbours, at most half a pixel away; a neighbour
/// outside the map or not finite means no shift along that axis. The amplitude is the pixel's.
///
/// unit_5x5: blocks of 5x5 pixels, side by side from the top-left corner, whose mean exceeds the
/// threshold; the amplitude is the mean. P-HPMHT (20). The centre is the centroid of the
/// intensity above the block's minimum (a flat block: of its pixels). Blocks that the right and
/// bottom border cut, and blocks with pixels that are not finite, make do with the pixels they
/// have. Which blocks are points is decided in double, alike on every device.
struct FindPoints {
  static constexpr std::string_view name = "find_points";
  /// Of position and amplitude; which pixels or blocks are points is exact.
  static constexpr Tolerance tolerance{1e-4, 1e-5};

  enum class Mode { local_maximum, unit_5x5 };
  struct Args {
    FrameView map;
    Mode mode = Mode::local_maximum;
    float threshold = 0;
    int radius = 1;  ///< of the neighbourhood [px], >= 0, local maxima only; of equal values the
                     ///< first in row order wins. NaN pixels are no points and beat nobody.
    std::vector<Point>* points = nullptr;  ///< needed; replaced; row by row, left to right
    PointWorkspace* workspace = nullptr;   ///< the call brings its own if not given
  };
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
  static std::vector<std::unique_ptr<Trial>> trials();
};

}  // namespace glint
