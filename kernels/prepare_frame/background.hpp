// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/trial.hpp"

namespace glint {

/// Images of one size and one pixel type.
using ImageStack =
    std::variant<std::span<const ImageView<const std::uint8_t>>,
                 std::span<const ImageView<const std::uint16_t>>, std::span<const FrameView>>;

/// Most images in a stack.
inline constexpr std::size_t kMaxStack = 64;

/// Per-pixel median of a stack of 1 .. kMaxStack images: the mean of the two middle values where
/// their number is even. NaN samples are left out; a pixel without any sample becomes NaN.
struct StackMedian {
  static constexpr std::string_view name = "stack_median";
  static constexpr Tolerance tolerance{0, 1e-6};
  struct Args {
    ImageStack stack;
    ImageView<float> median;  ///< of the images' size
  };
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
};

/// Spatial median on a lattice: of the 5x5 pixels that lie 0, +-spacing, +-2 spacing away along
/// each axis, those beyond the border replaced by the nearest pixel of the frame. NaN pixels are
/// left out; a pixel without any neighbour becomes NaN.
struct SpatialMedian {
  static constexpr std::string_view name = "spatial_median";
  static constexpr Tolerance tolerance{0, 1e-6};
  static constexpr int kMaxSpacing = 15;
  struct Args {
    FrameView image;
    int spacing = 4;          ///< 1 .. kMaxSpacing [px]; the window is 4 spacing + 1 pixels wide
    ImageView<float> median;  ///< of the image's size
  };
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
};

}  // namespace glint
