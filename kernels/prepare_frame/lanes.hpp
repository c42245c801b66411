// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>

#include "glint/kernels/core/isa.hpp"
#include "glint/kernels/prepare_frame/median_network.hpp"
#include "glint/kernels/prepare_frame/whiten.hpp"

namespace glint {

/// Rows of raw pixels to grey.
template <class T>
struct GreyPass {
  const T* raw;
  std::ptrdiff_t raw_pitch;
  int width, channels;
  bool reciprocal, stream;  ///< stream: store past the caches
  float floor, largest;
  float* grey;
  std::ptrdiff_t grey_pitch;
};

/// Per-pixel median of images.
template <class T>
struct StackPass {
  const T* images[kMaxStack];
  std::ptrdiff_t pitches[kMaxStack];
  int width;
  float* median;
  std::ptrdiff_t median_pitch;
  const MedianNetwork* network;
};

struct LatticePass {
  const float* image;
  std::ptrdiff_t pitch;
  int width, height, spacing;
  float* median;
  std::ptrdiff_t median_pitch;
  const MedianNetwork* network;
};

struct StructurePass {
  const float* background;
  std::ptrdiff_t pitch;
  int width, height;
  float* structure;
  std::ptrdiff_t structure_pitch;
  float share;
};

/// Widest tile of Whiten and BackgroundStructure [px].
inline constexpr int kTileColumns = 1024;

struct WhitenPass {
  const float *image, *background, *structure;  ///< structure: null for none
  std::ptrdiff_t image_pitch, background_pitch, structure_pitch;
  int width, height, outer, inner;
  float sigma, inverse_sigma;
  float energy_scale;                 ///< a residual of one sigma as an integer energy
  float energy_cap;                   ///< of the clipped residual
  std::int32_t keep_bits, flip_bits;  ///< make |r| or -r of r
  float offset, clip_low, clip_high;
  bool stream;
  float* whitened;
  std::ptrdiff_t whitened_pitch;
  float* noise;  ///< null for none
  std::ptrdiff_t noise_pitch;
  int noise_step;
};

/// What a call of Whiten comes to.
WhitenPass whiten_pass(const Whiten::Args& args);

/// A frame compared with another that is moved by (ix + ax, iy + ay), 0 <= ax, ay < 1.
struct ShiftPass {
  const float *reference, *moving;
  std::ptrdiff_t reference_pitch, moving_pitch;
  int width, height, ix, iy;
  float ax, ay;
};

struct DifferenceSums {
  double sum;
  std::int64_t count;
};

struct EquationSums {
  double xx, xy, yy, xe, ye;
};

struct KeyRange {
  std::int32_t least, most;
};

struct PrepareFrameLanes {
  /// Rows [y0, y1); true if a pixel became NaN.
  bool (*grey_u8)(const GreyPass<std::uint8_t>&, int y0, int y1);
  bool (*grey_u16)(const GreyPass<std::uint16_t>&, int y0, int y1);
  bool (*grey_f32)(const GreyPass<float>&, int y0, int y1);
  void (*stack_u8)(const StackPass<std::uint8_t>&, int y0, int y1);
  void (*stack_u16)(const StackPass<std::uint16_t>&, int y0, int y1);
  void (*stack_f32)(const StackPass<float>&, int y0, int y1);
  void (*lattice)(const LatticePass&, int y0, int y1);
  /// Columns [x0, x1), at most kTileColumns, of rows [y0, y1).
  void (*structure)(const StructurePass&, int x0, int x1, int y0, int y1);
  void (*whiten)(const WhitenPass&, int x0, int x1, int y0, int y1);
  KeyRange (*make_keys)(const float* values, std::int32_t* keys, int n);
  /// How many of the keys are <= pivot.
  int (*count_up_to)(const std::int32_t* keys, int n, std::int32_t pivot);
  void (*halve)(const float* upper, const float* lower, float* half, int n);
  DifferenceSums (*difference)(const ShiftPass&, int y);
  EquationSums (*equations)(const ShiftPass&, int y);
  void (*shift)(const ShiftPass&, float* moved, int y);
};
GLINT_DECLARE_LANES(PrepareFrameLanes, prepare_frame_lanes)

}  // namespace glint
