// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/held_frames.hpp"

#include <algorithm>
#include <utility>

namespace glint {

void HeldFrames::release() { wanted_ = std::min(wanted_, frames_.size()); }

/// Until there are enough or no more; lent pixels are copied, so that nobody waits for them to be
/// released.
void HeldFrames::fill(Source& source) {
  try {
    while (frames_.size() < wanted_) {
      std::optional<SourceFrame> frame = source.next();
      if (!frame) return;
      if (frame->pixels.width > 0) {
        own_pixels(*frame);
      } else {
        wanted_ = frames_.size() + 1;  // points have no background: this one is the last
      }
      frames_.push_back(std::move(*frame));
    }
  } catch (...) {
    error_ = std::current_exception();
    release();
  }
}

/// Stops at a frame that is damaged: the run that comes to it says so.
void HeldFrames::teach(FramePreparer& preparer) {
  wanted_ = 0;
  try {
    for (const SourceFrame& frame : frames_) preparer.learn(frame.pixels);
  } catch (const std::exception&) {
    return;
  }
}

void HeldFrames::read(Source& source, FramePreparer& preparer, std::optional<SourceFrame>& frame) {
  frame.reset();
  if (frames_.size() < wanted_) fill(source);
  if (frames_.size() < wanted_) return;
  if (wanted_ > 0) teach(preparer);
  if (!frames_.empty()) {
    frame.emplace(std::move(frames_.front()));
    frames_.pop_front();
  } else if (error_) {
    std::rethrow_exception(std::exchange(error_, {}));
  } else {
    frame = source.next();
  }
}

}  // namespace glint
