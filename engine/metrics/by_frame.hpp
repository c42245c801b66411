// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "glint/engine/metrics/metrics.hpp"

namespace glint {

/// Memory grows with the frames, so a slip in a table must not ask for all of it.
inline constexpr std::int64_t kMaxFrames = 10'000'000;

/// One more than the last frame that `points` speak of.
template <class P>
std::int64_t frame_count(std::span<const P> points) {
  std::int64_t count = 0;
  for (const P& point : points) count = std::max(count, point.frame + 1);
  return count;
}

/// The points of each frame 0 to `frames` - 1, in their order; later ones are left out. Throws
/// std::invalid_argument for a negative frame and for more than kMaxFrames frames.
template <class P>
std::vector<std::vector<P>> by_frame(std::span<const P> points, std::int64_t frames) {
  if (frames < 0 || frames > kMaxFrames) {
    throw std::invalid_argument("at most 10000000 frames can be scored, got " +
                                std::to_string(frames) + "; check the column frame");
  }
  std::vector<std::vector<P>> sorted(static_cast<std::size_t>(frames));
  for (const P& point : points) {
    if (point.frame < 0) throw std::invalid_argument("frames are counted from 0");
    if (point.frame < frames) sorted[static_cast<std::size_t>(point.frame)].push_back(point);
  }
  return sorted;
}

template <class P>
std::vector<Position> positions(const std::vector<P>& points) {
  std::vector<Position> result;
  result.reserve(points.size());
  for (const P& point : points) result.push_back({point.x, point.y});
  return result;
}

}  // namespace glint
