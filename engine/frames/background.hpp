// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "glint/engine/frames/frame_preparer.hpp"
#include "glint/engine/state/bytes.hpp"

namespace glint {

/// A frame as background models see it.
struct BackgroundInput {
  const RawPixels& raw;
  FrameView grey;  ///< NaN where the pixel is masked
  bool exact;      ///< grey is the raw pixels unchanged: samples may be kept as they came
};

/// Background of a stream of frames. For each frame: estimate(), then learn().
class Background {
 public:
  virtual ~Background() = default;
  /// Writes the frame's background; false if it is the one of the frame before.
  virtual bool estimate(const BackgroundInput& input, ImageView<float> background) = 0;
  /// Takes the frame as a sample of those to come, if its turn has come.
  virtual void learn(const BackgroundInput& input) = 0;
  /// True if the last estimate is a stand-in: a spatial median, for want of earlier frames.
  virtual bool provisional() const { return false; }
  /// Makes the next estimate() write the background even if it has not changed.
  virtual void rewrite() {}
  virtual std::string description() const = 0;
  /// What later backgrounds depend on, and back, for frames of this size, in a model of the same
  /// config; rewrite() follows. restore() throws BytesError.
  virtual void save(ByteWriter& to) const = 0;
  virtual void restore(ByteReader& from, int width, int height) = 0;
};

std::unique_ptr<Background> make_background(const FramesConfig& config, const Device& device);

}  // namespace glint
