// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gst/video/video.h>

#include <optional>
#include <span>

#include "glint/engine/engine.hpp"

namespace glint::gstreamer {

/// Pixels [left, right) x [top, bottom).
struct Box {
  int left = 0, top = 0, right = 0, bottom = 0;
};

/// What lies within `radius` [px] of a track, as far as the picture goes; none outside of it or
/// for a position that is not known.
std::optional<Box> box_around(const TrackPoint& point, int radius, int width, int height);

/// Draws the outline of a box around each confirmed track into the grey picture: a ring of the
/// picture's brightest level in one of its darkest, so that it shows on any ground.
void draw_boxes(GstVideoFrame& picture, std::span<const Track> tracks);

/// Half a box's side [px], without the middle: the box is 7 px wide, +-3 sigma of the default point
/// spread.
constexpr int kBoxRadius = 3;

}  // namespace glint::gstreamer
