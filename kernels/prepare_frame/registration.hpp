// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/trial.hpp"

namespace glint {

/// Translation between two frames: moving(x + dx, y + dy) shows what reference(x, y) shows.
struct Shift {
  double dx = 0, dy = 0;  ///< [px]
  double unshifted = 0;   ///< mean absolute difference without the shift [grey levels]
  double shifted = 0;     ///< and with it
  bool improves(double share) const { return shifted < (1 - share) * unshifted; }
};

/// Half-size image: means of 2x2 pixels; an odd last row or column is dropped. A mean with a NaN is
/// NaN.
struct Halve {
  static constexpr std::string_view name = "halve";
  static constexpr Tolerance tolerance{0, 1e-6};
  struct Args {
    FrameView image;
    ImageView<float> half;  ///< width / 2 x height / 2
  };
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
};

/// Translation of one frame against another: exhaustive search of the smallest mean absolute
/// difference on the coarsest level of a pyramid, +-1 px on each finer one, then Gauss-Newton to a
/// fraction of a pixel on the finest. NaN pixels are left out. Deterministic; shifts by more than a
/// quarter of the frame are not found.
struct EstimateShift {
  static constexpr std::string_view name = "estimate_shift";
  static constexpr Tolerance tolerance{2e-3, 1e-3};
  struct Args {
    std::span<const FrameView> reference, moving;  ///< finest first, each half of the one before
    int max_shift = 32;                            ///< [px]
    Shift* shift = nullptr;
  };
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
};

/// The image moved by a translation, bilinear: moved(x, y) = image(x + dx, y + dy); NaN where the
/// image shows nothing.
struct ShiftImage {
  static constexpr std::string_view name = "shift_image";
  static constexpr Tolerance tolerance{1e-3, 1e-5};
  struct Args {
    FrameView image;
    double dx = 0, dy = 0;   ///< [px]
    ImageView<float> moved;  ///< of the image's size
  };
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
};

}  // namespace glint
