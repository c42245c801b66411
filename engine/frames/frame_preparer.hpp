// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "glint/engine/frames/frames_config.hpp"
#include "glint/engine/scan.hpp"
#include "glint/engine/state/bytes.hpp"
#include "glint/kernels/core/device.hpp"
#include "glint/kernels/prepare_frame/prepare_frame.hpp"

namespace glint {

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
  void learn(const RawPixels& given);
  /// The next frame of the stream. Fills frame-related members of a Scan: `raw` is the grey frame,
  /// reciprocal if so configured, its NaN pixels replaced by the background (0 where there is
  /// none); `whitened` is z, 0 where masked (pixels that are no numbers, beyond ToGrey::kLargest,
  /// or ignored); `noise_sigma`. Throws std::invalid_argument for an empty frame, one of more than
  /// kMaxSide px a side, other than 1, 3 or 4 channels, a pitch
  /// below a row, or a size other than the first frame's.
  Scan prepare(const RawPixels& given, std::int64_t frame, double time);
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
