// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <deque>
#include <map>
#include <opencv2/core.hpp>
#include <span>
#include <utility>
#include <vector>

#include "glint/engine/tracks/track_log.hpp"
#include "glint/kernels/core/frame.hpp"

namespace glint {

/// Draws frames and tracks as a person wants to see them: grey levels stretched, small frames
/// scaled up, each track in a colour of its own with a circle, its number and a tail.
class Painter {
 public:
  /// Where tracks have been lately. Key: tracker, track.
  using Tails = std::map<std::pair<std::size_t, std::int64_t>, std::deque<TrackPoint>>;

  /// Small frames are scaled up, by a whole number, to about `width` [px].
  explicit Painter(int width) : width_(width) {}

  /// Updates the tails with what each tracker reported of the frame.
  void follow(std::span<const std::vector<TrackPoint>> reported);
  const Tails& tails() const { return tails_; }

  /// The frame in grey, 8-bit BGR, scaled. `steady` in [0, 1) is the share of the last call's
  /// stretch that this one keeps, against flicker.
  cv::Mat grey(FrameView frame, double steady);
  /// Draws the confirmed tracks of `tails` over a picture that grey() made.
  void draw(cv::Mat& picture, const Tails& tails) const;

 private:
  cv::Point2d on_picture(const TrackPoint& point) const;

  Tails tails_;
  int width_, scale_ = 1;
  double low_ = 0, high_ = 0;  // grey levels shown as black and white
};

}  // namespace glint
