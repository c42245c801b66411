// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "glint/engine/config.hpp"
#include "glint/engine/scan.hpp"
#include "glint/engine/state/bytes.hpp"
#include "glint/kernels/core/device.hpp"
#include "glint/kernels/prepare_frame/prepare_frame.hpp"

namespace glint {

/// How raw pixels become whitened frames.
struct FramesConfig {
  std::string polarity = "bright";       ///< bright, dark, both
  std::string background = "temporal";   ///< temporal, registered, spatial, none
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

/// Turns a stream of raw frames into whitened ones: grey, background, noise sigma, z. Causal: a
/// frame's background comes from the frames before it and those of learn(), and from a spatial
/// median while there are none. Earlier Scans stay valid: their frames are reused only when nobody
/// holds them any more.
class FramePreparer {
 public:
  FramePreparer(const FramesConfig& config, const Device& device);
  ~FramePreparer();
  FramePreparer(FramePreparer&&) noexcept;
  FramePreparer& operator=(FramePreparer&&) noexcept;

  /// Pixels to leave out of everything from now on, those that are not 0 (bad pixels, overlays);
  /// an empty image for none. prepare() throws if the size is not the frames'.
  void set_mask(Image<std::uint8_t> ignored);

  /// Lets the background learn a frame that is not to be tracked yet, before the first prepare().
  /// Throws as that does.
  void learn(const RawPixels& raw);
  /// The next frame of the stream. Fills frame-related members of a Scan: `raw` is the grey frame,
  /// reciprocal if so configured, its NaN pixels replaced by the background (0 where there is
  /// none); `whitened` is z, 0 where masked (pixels that are no numbers, beyond ToGrey::kLargest,
  /// or ignored); `noise_sigma`. Throws std::invalid_argument for an empty frame, one of more than
  /// kMaxSide px a side, other than 1, 3 or 4 channels, or a size other than the first frame's.
  Scan prepare(const RawPixels& raw, std::int64_t frame, double time);
  /// What was estimated, for the summary ("noise sigma 4.2 grey levels").
  std::vector<std::string> notes() const;

  /// What later frames depend on, the mask included, and back into a preparer of the same config
  /// and kind of device. restore() throws BytesError.
  void save(ByteWriter& to) const;
  void restore(ByteReader& from);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace glint
