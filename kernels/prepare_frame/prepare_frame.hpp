// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/raw_pixels.hpp"
#include "glint/kernels/core/trial.hpp"
#include "glint/kernels/prepare_frame/background.hpp"
#include "glint/kernels/prepare_frame/registration.hpp"
#include "glint/kernels/prepare_frame/whiten.hpp"

namespace glint {

/// Raw pixels to a grey float frame, .2989 R + .587 G + .114 B (P-HPMHT (1)), optionally
/// reciprocal, 255 / max(I, floor) (P-HPMHT (2) with a floor for dark pixels). Bad pixels,
/// which are not finite or beyond +-kLargest, become NaN.
struct ToGrey {
  static constexpr std::string_view name = "to_grey";
  static constexpr Tolerance tolerance{1e-5, 1e-6};
  static constexpr float kLargest = 1e15f;  ///< sums of squares of as many as fit stay finite
  struct Args {
    RawPixels raw;
    bool reciprocal = false;
    float reciprocal_floor = 12;
    ImageView<float> grey;
    bool* masked = nullptr;  ///< if given, set to whether any pixel became NaN
  };
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
};

/// The trials of all kernels of this folder.
std::vector<std::unique_ptr<Trial>> prepare_frame_trials();

}  // namespace glint
