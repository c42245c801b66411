// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/engine/config.hpp"
#include "glint/kernels/prepare_frame/whiten.hpp"

namespace glint {

enum class BackgroundKind {
  temporal,    ///< median over past frames
  registered,  ///< the same after registration, for a camera that moves
  spatial,     ///< median over a window of the frame itself
  none         ///< frames are whitened already
};

/// How raw pixels become whitened frames.
struct FramesConfig {
  Polarity polarity = Polarity::bright;
  BackgroundKind background = BackgroundKind::temporal;
  bool reciprocal = false;               ///< work on 255 / I: dark targets on a bright sky
  double reciprocal_floor = 12;          ///< darker pixels count as this dark [grey levels]
  int background_frames = 90;            ///< span of the temporal median [frames]
  int background_stride = 6;             ///< from one of its samples to the next [frames]
  int background_prime = 0;              ///< learned from this many first frames before them all
  int registered_frames = 31;            ///< samples of the registered median
  int registered_stride = 1;             ///< from one of them to the next [frames]
  int max_shift = 32;                    ///< largest movement between them [px]
  double registration_gain = 0.2;        ///< a shift must lower the mean difference by this share
  int spatial_window = 17;               ///< width of the spatial median [px]
  double sigma_floor = 0;                ///< least noise sigma [grey levels]; 0 = automatic
  bool structure = true;                 ///< the background's gradient raises sigma
  bool ring = true;                      ///< the residual around a pixel raises sigma
  int ring_outer = 31, ring_inner = 11;  ///< widths of the ring's boxes [px]
  double ring_clip = 10;                 ///< residuals count at most this much there [sigma]
  double clip_low = -3, clip_high = 8;   ///< limits of z
};
void describe(FieldList& list, FramesConfig& config);

}  // namespace glint
