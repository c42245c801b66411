// SPDX-License-Identifier: Apache-2.0
// Local maxima or bright units of a band: spans of them are counted, then written in order. What
// decides is exact: comparisons, and sums in double in the reference's order.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/find_points/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { PointBand band; };
layout(std430, binding = 1) readonly buffer Map { float map[]; };
layout(std430, binding = 2) buffer Counts { uint counts[]; };  // of a span; later, of all before it
struct Point {
  float x, y, amplitude;
};
layout(std430, binding = 3) writeonly buffer Points { Point points[]; };

float pixel(int x, int y) { return map[(y - band.top) * band.width + x]; }
bool in_map(int x, int y) { return x >= 0 && x < band.width && y >= 0 && y < band.height; }
bool finite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }
bool is_nan(float x) { return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u; }

bool is_maximum(int x, int y) {
  float value = pixel(x, y);
  if (is_nan(value) || !(value > band.threshold)) return false;
  for (int v = max(0, y - band.radius); v <= min(band.height - 1, y + band.radius); ++v) {
    for (int u = max(0, x - band.radius); u <= min(band.width - 1, x + band.radius); ++u) {
      float other = pixel(u, v);
      bool earlier = v < y || (v == y && u < x);
      if (!is_nan(other) && (other > value || (earlier && other == value))) return false;
    }
  }
  return true;
}

// Vertex of the parabola through a pixel and the two that lie (dx, dy) before and after it.
float vertex(int x, int y, int dx, int dy) {
  if (!in_map(x - dx, y - dy) || !in_map(x + dx, y + dy)) return 0.0;
  float before = pixel(x - dx, y - dy), after = pixel(x + dx, y + dy);
  if (!finite(before) || !finite(pixel(x, y)) || !finite(after)) return 0.0;
  precise double fall_before = double(pixel(x, y)) - double(before);
  precise double fall_after = double(pixel(x, y)) - double(after);
  precise double curvature = fall_before + fall_after;
  if (!(curvature > 0.0lf)) return 0.0;
  return float(clamp(0.5lf * (fall_before - fall_after) / curvature, -0.5lf, 0.5lf));
}

struct Moments {
  double sum;
  float minimum;
  int count;
};

// Whether the unit at (x, y) has the pixel (u, v) further on, with a number in it. Units are run over
// in loops of one length, for with bounds of their own llvmpipe (Mesa 22.3) was seen to give units
// that the border cuts a wrong centroid.
bool has(int x, int y, int u, int v) {
  return x + u < band.width && y + v < band.height && finite(pixel(x + u, y + v));
}

Moments moments(int x, int y) {
  Moments m = Moments(0.0lf, uintBitsToFloat(0x7f800000u), 0);
  for (int u = 0; u < kUnit; ++u) {
    precise double column = 0.0lf;
    for (int v = 0; v < kUnit; ++v) {
      if (!has(x, y, u, v)) continue;
      float value = pixel(x + u, y + v);
      column += double(value);
      m.minimum = min(m.minimum, value);
      ++m.count;
    }
    m.sum += column;
  }
  return m;
}

// P-HPMHT (20), times the number of pixels.
bool is_bright(Moments m) {
  return m.count > 0 && m.sum > double(band.threshold) * double(m.count);
}

Point bright_unit(int x, int y, Moments m) {
  double mass = 0.0lf, x_mass = 0.0lf, y_mass = 0.0lf;
  int x_pixels = 0, y_pixels = 0;
  for (int v = 0; v < kUnit; ++v) {
    for (int u = 0; u < kUnit; ++u) {
      if (!has(x, y, u, v)) continue;
      double w = double(pixel(x + u, y + v)) - double(m.minimum);
      mass += w;
      x_mass += w * double(u);
      y_mass += w * double(v);
      x_pixels += u;
      y_pixels += v;
    }
  }
  float dx = float(x_pixels) / float(m.count), dy = float(y_pixels) / float(m.count);
  if (mass > 0.0lf) dx = float(x_mass / mass), dy = float(y_mass / mass);
  return Point(float(x) + dx, float(y) + dy, float(m.sum / double(m.count)));
}

int columns() { return band.units != 0u ? (band.width + kUnit - 1) / kUnit : band.width; }
int items() {
  int rows = band.last - band.first;
  return columns() * (band.units != 0u ? (rows + kUnit - 1) / kUnit : rows);
}

// Pixel of item i, the top left one of a unit.
ivec2 place(int i) {
  int side = band.units != 0u ? kUnit : 1;
  return ivec2(i % columns() * side, band.first + i / columns() * side);
}

bool is_point(int i) {
  ivec2 at = place(i);
  return band.units != 0u ? is_bright(moments(at.x, at.y)) : is_maximum(at.x, at.y);
}

Point point_of(int i) {
  ivec2 at = place(i);
  if (band.units != 0u) return bright_unit(at.x, at.y, moments(at.x, at.y));
  return Point(float(at.x) + vertex(at.x, at.y, 1, 0), float(at.y) + vertex(at.x, at.y, 0, 1),
               pixel(at.x, at.y));
}

void count_points() {
  int span = int(item()), last = min((span + 1) * kSpan, items());
  if (span * kSpan >= items()) return;
  uint count = 0u;
  for (int i = span * kSpan; i < last; ++i) count += is_point(i) ? 1u : 0u;
  counts[span] = count;
}

void collect_points() {
  int span = int(item()), last = min((span + 1) * kSpan, items());
  if (span * kSpan >= items()) return;
  uint next = counts[span];
  for (int i = span * kSpan; i < last; ++i) {
    if (!is_point(i)) continue;
    points[next] = point_of(i);
    ++next;
  }
}
