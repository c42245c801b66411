// SPDX-License-Identifier: Apache-2.0
// A frame beside one that is moved: the image moved back, and sums over spans of rows of absolute
// differences and of the normal equations of a Gauss-Newton step.
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/core/glsl.glsl"
#include "glint/kernels/prepare_frame/keys.glsl"
#include "glint/kernels/prepare_frame/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { MovedBand band; };
layout(std430, binding = 1) readonly buffer Reference { float reference[]; };
layout(std430, binding = 2) readonly buffer Moving { float moving[]; };
layout(std430, binding = 3) writeonly buffer Moved { float moved[]; };
layout(std430, binding = 4) writeonly buffer Differences { DifferenceSum differences[]; };
layout(std430, binding = 5) writeonly buffer Equations { EquationSum equations[]; };

int right() { return band.ax > 0.0 ? 1 : 0; }
int below() { return band.ay > 0.0 ? 1 : 0; }

// Whether the moving frame shows what the reference's pixel (x, y) does.
bool shows(int x, int y) {
  int u = x + band.ix, v = y + band.iy;
  return u >= 0 && u + right() < band.width && v >= 0 && v + below() < band.height;
}
// Bilinear value there.
float moved_at(int x, int y) {
  int at = (y + band.iy - band.moving_top) * band.width + x + band.ix;
  int under = at + below() * band.width;
  precise float top = fma(band.ax, moving[at + right()] - moving[at], moving[at]);
  precise float bottom = fma(band.ax, moving[under + right()] - moving[under], moving[under]);
  precise float value = fma(band.ay, bottom - top, top);
  return value;
}
float reference_at(int x, int y) { return reference[(y - band.top) * band.width + x]; }

void shift() {
  int i = int(item());
  if (i >= band.width * band.rows) return;
  int x = i % band.width, y = band.first + i / band.width;
  moved[i] = shows(x, y) ? moved_at(x, y) : uintBitsToFloat(0x7fc00000u);
}

struct Span {
  int y, left, right;
};
int spans() { return (band.width + kColumns - 1) / kColumns; }
Span span_of(int i) {
  int left = i % spans() * kColumns;
  return Span(band.first + i / spans() * band.step, left, left + kColumns);
}

void sum_differences() {
  int i = int(item());
  if (i >= spans() * band.rows) return;
  Span span = span_of(i);
  precise double sum = 0.0lf;
  uint count = 0u;
  for (int x = span.left; x < span.right; ++x) {
    if (!shows(x, span.y) || x >= band.width) continue;
    precise float difference = moved_at(x, span.y) - reference_at(x, span.y);
    if (is_nan(difference)) continue;
    sum += double(abs(difference));
    ++count;
  }
  differences[i] = DifferenceSum(sum, count, 0u);
}

void sum_equations() {
  int i = int(item());
  if (i >= spans() * band.rows) return;
  Span span = span_of(i);
  EquationSum sum = EquationSum(0.0lf, 0.0lf, 0.0lf, 0.0lf, 0.0lf);
  for (int x = span.left; x < span.right; ++x) {
    if (x < 1 || x >= band.width - 1 || !shows(x, span.y)) continue;
    precise float across = reference_at(x + 1, span.y) - reference_at(x - 1, span.y);
    precise float down = reference_at(x, span.y + 1) - reference_at(x, span.y - 1);
    precise float error = moved_at(x, span.y) - reference_at(x, span.y);
    if (is_nan(across) || is_nan(down) || is_nan(error)) continue;
    double gx = 0.5lf * double(across), gy = 0.5lf * double(down), e = double(error);
    sum.xx += gx * gx, sum.xy += gx * gy, sum.yy += gy * gy;
    sum.xe += gx * e, sum.ye += gy * e;
  }
  equations[i] = sum;
}
