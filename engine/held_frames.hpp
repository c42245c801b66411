// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <deque>
#include <exception>
#include <optional>

#include "glint/engine/frames/frame_preparer.hpp"
#include "glint/engine/source.hpp"

namespace glint {

/// The first frames of a stream, held until the background is learned from them.
class HeldFrames {
 public:
  /// Before the first read(): how many frames the background is learned from.
  void hold(std::size_t frames) { wanted_ = frames; }
  bool empty() const { return frames_.empty(); }
  /// The next read() learns from those that are held by now, and holds no more.
  void release();
  void clear() { frames_.clear(), wanted_ = 0; }
  /// The next frame of the stream into `frame`: the first that is held once `preparer` has learned
  /// from all of them, later those of `source`; nothing while more are to be held, and at the end.
  /// What the source throws comes out after the frames that were held.
  void read(Source& source, FramePreparer& preparer, std::optional<SourceFrame>& frame);

 private:
  void fill(Source& source);
  void teach(FramePreparer& preparer);

  std::deque<SourceFrame> frames_;
  std::size_t wanted_ = 0;
  std::exception_ptr error_;  // of the source
};

}  // namespace glint
