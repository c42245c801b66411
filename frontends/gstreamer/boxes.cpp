// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/gstreamer/boxes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace glint::gstreamer {
namespace {

template <class T>
struct Picture {
  T* row(int y) const {
    return reinterpret_cast<T*>(static_cast<std::uint8_t*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, 0)) +
                                std::ptrdiff_t{y} * GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0));
  }
  GstVideoFrame& frame;
  int width = GST_VIDEO_FRAME_WIDTH(&frame), height = GST_VIDEO_FRAME_HEIGHT(&frame);
};

template <class T>
std::pair<T, T> darkest_and_brightest(const Picture<T>& picture) {
  T low = *picture.row(0), high = low;
  for (int y = 0; y < picture.height; ++y) {
    const T* row = picture.row(y);
    const auto [least, most] = std::minmax_element(row, row + picture.width);
    low = std::min(low, *least), high = std::max(high, *most);
  }
  return {low, high};
}

/// The pixels whose distance from the track is `radius`, along the axis where it is larger.
template <class T>
void draw_ring(const Picture<T>& picture, const TrackPoint& point, int radius, T level) {
  const auto box = box_around(point, radius, picture.width, picture.height);
  if (!box) return;
  const auto middle_x = static_cast<int>(std::lround(point.x));
  const auto middle_y = static_cast<int>(std::lround(point.y));
  for (int y = box->top; y < box->bottom; ++y) {
    T* row = picture.row(y);
    for (int x = box->left; x < box->right; ++x) {
      if (std::max(std::abs(x - middle_x), std::abs(y - middle_y)) == radius) row[x] = level;
    }
  }
}

template <class T>
void draw_all(GstVideoFrame& frame, std::span<const Track> tracks) {
  const Picture<T> picture{frame};
  const auto [dark, bright] = darkest_and_brightest(picture);
  for (const Track& point : tracks) {
    if (point.status != TrackStatus::confirmed) continue;
    draw_ring(picture, point, kBoxRadius + 1, bright);
    draw_ring(picture, point, kBoxRadius + 2, dark);
  }
}

}  // namespace

std::optional<Box> box_around(const TrackPoint& point, int radius, int width, int height) {
  // Written so that NaN is outside as well.
  const bool inside =
      point.x > -0.5 && point.x < width - 0.5 && point.y > -0.5 && point.y < height - 0.5;
  if (!inside) return std::nullopt;
  const auto x = static_cast<int>(std::lround(point.x));
  const auto y = static_cast<int>(std::lround(point.y));
  return Box{std::max(0, x - radius), std::max(0, y - radius), std::min(width, x + radius + 1),
             std::min(height, y + radius + 1)};
}

void draw_boxes(GstVideoFrame& picture, std::span<const Track> tracks) {
  if (GST_VIDEO_FRAME_FORMAT(&picture) == GST_VIDEO_FORMAT_GRAY8) {
    draw_all<std::uint8_t>(picture, tracks);
  } else {
    draw_all<std::uint16_t>(picture, tracks);
  }
}

}  // namespace glint::gstreamer
