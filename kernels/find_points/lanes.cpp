// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/find_points/lanes.hpp"

#include "glint/kernels/core/inline.hpp"

namespace glint::GLINT_LANES {
namespace {

// As wide as the registers: compilers compare wider vectors lane by lane.
#if defined(__AVX512F__)
constexpr int kLanes = 16;
#elif defined(__AVX2__)
constexpr int kLanes = 8;
#else
constexpr int kLanes = 4;
#endif
using Floats = float __attribute__((vector_size(4 * kLanes)));
using Mask = std::int32_t __attribute__((vector_size(4 * kLanes)));
using Halves = std::int64_t __attribute__((vector_size(4 * kLanes)));

struct Map {
  const float* data;
  std::ptrdiff_t pitch;
  int width, height, radius;
  float threshold;
};

GLINT_INLINE Floats load(const float* p) {
  Floats v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}

GLINT_INLINE bool any(Mask m) {
  const auto h = reinterpret_cast<Halves>(m);
  std::int64_t all = 0;
  for (int i = 0; i < kLanes / 2; ++i) all |= h[i];
  return all != 0;
}

/// Whether no neighbour of pixel (x, y) beats it.
GLINT_INLINE bool is_maximum(const Map& m, int x, int y) {
  const float value = m.data[y * m.pitch + x];
  const int top = y < m.radius ? -y : -m.radius;
  const int bottom = y + m.radius < m.height ? m.radius : m.height - 1 - y;
  const int left = x < m.radius ? -x : -m.radius;
  const int right = x + m.radius < m.width ? m.radius : m.width - 1 - x;
  for (int dy = top; dy <= bottom; ++dy) {
    const float* row = m.data + (y + dy) * m.pitch + x;
    for (int dx = left; dx <= right; ++dx) {
      const bool earlier = dy < 0 || (dy == 0 && dx < 0);
      if (row[dx] > value || (earlier && row[dx] == value)) return false;
    }
  }
  return true;
}

/// The same for kLanes pixels whose neighbourhoods no left or right border clips.
GLINT_INLINE Mask are_maxima(const Map& m, int x, int y) {
  const Floats value = load(m.data + y * m.pitch + x);
  Mask alive = value > m.threshold;
  const int top = y < m.radius ? -y : -m.radius;
  const int bottom = y + m.radius < m.height ? m.radius : m.height - 1 - y;
  for (int dy = top; dy <= bottom && any(alive); ++dy) {
    const float* row = m.data + (y + dy) * m.pitch + x;
    for (int dx = -m.radius; dx <= m.radius; ++dx) {
      const Floats other = load(row + dx);
      const bool earlier = dy < 0 || (dy == 0 && dx < 0);
      alive &= earlier ? ~(other >= value) : ~(other > value);
    }
  }
  return alive;
}

GLINT_INLINE int settle_lanes(const Map& m, int x, int y, std::int32_t* found) {
  const Mask alive = are_maxima(m, x, y);
  int n = 0;
  for (int i = 0; i < kLanes; ++i) {
    found[n] = x + i;
    n -= alive[i];
  }
  return n;
}

GLINT_INLINE int settle_pixels(const Map& m, int x, int end, int y, std::int32_t* found) {
  int n = 0;
  for (; x < end; ++x) {
    if (m.data[y * m.pitch + x] > m.threshold && is_maximum(m, x, y)) found[n++] = x;
  }
  return n;
}

int groups_above(const float* row, int width, float threshold, std::int32_t* groups) {
  constexpr int kStrip = 4 * kLanes;
  int n = 0, x = 0;
  // Most strips hold nothing above the threshold: one branch for all of their pixels.
  for (; x + kStrip <= width; x += kStrip) {
    Mask above[4];
    for (int i = 0; i < 4; ++i) above[i] = load(row + x + i * kLanes) > threshold;
    if (!any((above[0] | above[1]) | (above[2] | above[3]))) continue;
    for (int i = 0; i < 4; ++i) {
      groups[n] = x + i * kLanes;
      n += any(above[i]);
    }
  }
  for (; x < width; x += kLanes) groups[n++] = x;
  return n;
}

int maxima(const float* map, std::ptrdiff_t pitch, int width, int height, int y, float threshold,
           int radius, const std::int32_t* groups, int group_count, std::int32_t* found) {
  const Map m{map, pitch, width, height, radius, threshold};
  int n = 0;
  for (int g = 0; g < group_count; ++g) {
    const int x = groups[g], end = x + kLanes;
    const bool clipped = x < radius || end + radius > width;
    n += clipped ? settle_pixels(m, x, end < width ? end : width, y, found + n)
                 : settle_lanes(m, x, y, found + n);
  }
  return n;
}

/// Whether the mean of the block's finite pixels exceeds the threshold. Sums by columns first, as
/// the reference does, so that both decide alike.
GLINT_INLINE bool finite_mean_exceeds(const float* block, std::ptrdiff_t pitch, int columns,
                                      int rows, double threshold) {
  double sum = 0;
  int count = 0;
  for (int x = 0; x < columns; ++x) {
    double column = 0;
    for (int y = 0; y < rows; ++y) {
      const float value = block[y * pitch + x];
      const bool finite = value - value == 0.0f;
      column += finite ? static_cast<double>(value) : 0.0;
      count += finite;
    }
    sum += column;
  }
  return count > 0 && sum > threshold * count;
}

constexpr int kBlocks = 16;

GLINT_INLINE void column_sums(const float* block, std::ptrdiff_t pitch, int rows, double* column) {
  for (int i = 0; i < 5 * kBlocks; ++i) {
    double sum = static_cast<double>(block[i]);
    for (int y = 1; y < rows; ++y) sum += static_cast<double>(block[y * pitch + i]);
    column[i] = sum;
  }
}

int units(const float* band, std::ptrdiff_t pitch, int width, int rows, float threshold,
          std::int32_t* found) {
  const double limit = static_cast<double>(threshold) * (5 * rows);
  int n = 0, unit = 0;
  for (; 5 * (unit + kBlocks) <= width; unit += kBlocks) {
    const float* blocks = band + 5 * unit;
    double column[5 * kBlocks];
    rows == 5 ? column_sums(blocks, pitch, 5, column) : column_sums(blocks, pitch, rows, column);
    for (int b = 0; b < kBlocks; ++b) {
      const double* c = column + 5 * b;
      const double sum = (((c[0] + c[1]) + c[2]) + c[3]) + c[4];
      const bool finite = sum - sum == 0;
      found[n] = unit + b;
      n += finite ? sum > limit : finite_mean_exceeds(blocks + 5 * b, pitch, 5, rows, threshold);
    }
  }
  for (; 5 * unit < width; ++unit) {
    const int columns = width - 5 * unit < 5 ? width - 5 * unit : 5;
    found[n] = unit;
    n += finite_mean_exceeds(band + 5 * unit, pitch, columns, rows, threshold);
  }
  return n;
}

}  // namespace

extern const FindPointsLanes find_points_lanes;
const FindPointsLanes find_points_lanes = {groups_above, maxima, units};

}  // namespace glint::GLINT_LANES
