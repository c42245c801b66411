// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/find_points/find_points.hpp"
#include "glint/kernels/find_points/lanes.hpp"

namespace glint {
namespace {

/// Pixels a tile, about 20 us; a tile is whole rows of blocks.
constexpr std::size_t kTilePixels = std::size_t{1} << 17;

Tiles row_tiles(FrameView map) {
  const std::size_t band = 5 * static_cast<std::size_t>(map.width);
  return {static_cast<std::size_t>(map.height), 5 * ((kTilePixels + band - 1) / band)};
}

float vertex(float before, float middle, float after) {
  const float fall_before = middle - before, fall_after = middle - after;
  const float curvature = fall_before + fall_after;
  if (!(std::isfinite(curvature) && curvature > 0)) return 0;
  return std::clamp(0.5f * (fall_before - fall_after) / curvature, -0.5f, 0.5f);
}

Point refined(FrameView map, int x, int y) {
  constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
  const float* p = map.row(y) + x;
  const float left = x > 0 ? p[-1] : kMissing, right = x + 1 < map.width ? p[1] : kMissing;
  const float up = y > 0 ? p[-map.pitch] : kMissing;
  const float down = y + 1 < map.height ? p[map.pitch] : kMissing;
  return {static_cast<float>(x) + vertex(left, *p, right),
          static_cast<float>(y) + vertex(up, *p, down), *p};
}

/// Centroid of the intensity above the minimum, over the finite pixels.
Point centroid(FrameView map, const Box& block) {
  float minimum = std::numeric_limits<float>::infinity();
  double sum = 0;
  int count = 0, columns = 0, lines = 0;
  for (int x = block.x0; x < block.x1; ++x) {
    double column = 0;
    for (int y = block.y0; y < block.y1; ++y) {
      const float value = map(x, y);
      if (!std::isfinite(value)) continue;
      column += static_cast<double>(value);
      minimum = std::min(minimum, value);
      ++count, columns += x - block.x0, lines += y - block.y0;
    }
    sum += column;
  }
  float mass = 0, x_mass = 0, y_mass = 0;
  for (int y = block.y0; y < block.y1; ++y) {
    for (int x = block.x0; x < block.x1; ++x) {
      const float w = std::isfinite(map(x, y)) ? map(x, y) - minimum : 0;
      mass += w;
      x_mass += w * static_cast<float>(x - block.x0);
      y_mass += w * static_cast<float>(y - block.y0);
    }
  }
  const bool flat = !(mass > 0);
  const float dx = flat ? static_cast<float>(columns) / static_cast<float>(count) : x_mass / mass;
  const float dy = flat ? static_cast<float>(lines) / static_cast<float>(count) : y_mass / mass;
  return {static_cast<float>(block.x0) + dx, static_cast<float>(block.y0) + dy,
          static_cast<float>(sum / count)};
}

/// Looks for maxima one row behind the threshold, when the row below has come into the cache.
void maxima_of_rows(const FindPoints::Args& args, const FindPointsLanes& lanes, int y0, int y1,
                    std::int32_t* scratch, std::vector<Point>& points) {
  const FrameView map = args.map;
  std::int32_t *groups = scratch, *groups_below = groups + map.width,
               *found = groups_below + map.width;
  int n = lanes.groups_above(map.row(y0), map.width, args.threshold, groups);
  for (int y = y0; y < y1; ++y) {
    const int n_below =
        y + 1 < y1 ? lanes.groups_above(map.row(y + 1), map.width, args.threshold, groups_below)
                   : 0;
    const int count = lanes.maxima(map.data, map.pitch, map.width, map.height, y, args.threshold,
                                   args.radius, groups, n, found);
    for (int i = 0; i < count; ++i) points.push_back(refined(map, found[i], y));
    std::swap(groups, groups_below);
    n = n_below;
  }
}

void units_of_rows(const FindPoints::Args& args, const FindPointsLanes& lanes, int y0, int y1,
                   std::int32_t* scratch, std::vector<Point>& points) {
  const FrameView map = args.map;
  for (int y = y0; y < y1; y += 5) {
    const int bottom = std::min(y + 5, y1);
    const int n =
        lanes.units(map.row(y), map.pitch, map.width, bottom - y, args.threshold, scratch);
    for (int i = 0; i < n; ++i) {
      const int x = 5 * scratch[i];
      points.push_back(centroid(map, {x, y, std::min(x + 5, map.width), bottom}));
    }
  }
}

/// Leaves room to spare, so that frames with a few points more than ever do not allocate.
void leave_room(std::vector<Point>& points) {
  if (points.capacity() < 2 * points.size()) points.reserve(4 * points.size());
}

}  // namespace

void FindPoints::tbb(const Args& args, Workers& workers) {
  args.points->clear();
  if (args.map.empty()) return;
  PointWorkspace own;
  auto& tiles = (args.workspace != nullptr ? *args.workspace : own).tiles;
  const Tiles split = row_tiles(args.map);
  if (tiles.size() < split.tiles()) tiles.resize(split.tiles());
  const FindPointsLanes& lanes = find_points_lanes(workers.isa());
  const auto rows = args.mode == Mode::local_maximum ? maxima_of_rows : units_of_rows;
  workers.for_tiles(split.tiles(), [&](std::size_t t) {
    auto& [scratch, points] = tiles[t];
    points.clear();
    scratch.resize(3 * static_cast<std::size_t>(args.map.width));
    rows(args, lanes, static_cast<int>(split.begin(t)), static_cast<int>(split.end(t)),
         scratch.data(), points);
    leave_room(points);
  });
  for (std::size_t t = 0; t < split.tiles(); ++t) {
    args.points->insert(args.points->end(), tiles[t].points.begin(), tiles[t].points.end());
  }
  leave_room(*args.points);
}

}  // namespace glint
