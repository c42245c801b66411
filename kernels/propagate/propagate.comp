// SPDX-License-Identifier: Apache-2.0
// One step of every particle: switch the model, x' = F x + w, walk the intensity. P-PHD (1), (31),
// (32), (34).
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/core/glsl.glsl"
#include "glint/kernels/core/math.glsl"
#include "glint/kernels/core/random.glsl"
#include "glint/kernels/propagate/draws.glsl"
#include "glint/kernels/propagate/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { DeviceStep pass; };
layout(std430, binding = 1) buffer X { float xs[]; };
layout(std430, binding = 2) buffer Y { float ys[]; };
layout(std430, binding = 3) buffer Vx { float vxs[]; };
layout(std430, binding = 4) buffer Vy { float vys[]; };
layout(std430, binding = 5) buffer Intensity { float intensities[]; };
layout(std430, binding = 6) buffer Ax { float axs[]; };
layout(std430, binding = 7) buffer Ay { float ays[]; };
layout(std430, binding = 8) buffer Mode { uint modes[]; };
layout(std430, binding = 9) readonly buffer Scale { float scales[]; };

uint switched(uint particle, uint mode) {
  Share share = share_of(particle, 4u);
  float u = uniform_of(keyed_words(pass.switch_key, share.item, 0u).w[share.part]);
  uint last = pass.modes - 1u, from = min(mode, last), to = 0u;
  while (to < last && pass.cumulative[8u * from + to] <= u) ++to;
  return to;
}

struct Noise {
  float position, velocity, acceleration;
};

struct Axis {
  float x, v, a;
};

// One axis: x' = x + along v -+ across v_other + half a + noise, likewise v and a.
Axis moved(Axis from, MoveTerms m, float turn, float other, Noise n) {
  precise float step = m.along * from.v + turn * m.across * other + m.half_square * from.a +
                       m.xx * n.position;
  precise float velocity = m.cosine * from.v + turn * m.sine * other + m.time * from.a +
                           m.vx * n.position + m.vv * n.velocity;
  precise float change = m.ax * n.position + m.av * n.velocity + m.aa * n.acceleration;
  return Axis(from.x + step, velocity, from.a + change);
}

NormalPair third_noise(uint particle) {
  Share share = share_of(particle, 2u);
  Words4 words = keyed_words(pass.key, share.item, kAccelerationDraw);
  return normals_of(words.w[2u * share.part], words.w[2u * share.part + 1u]);
}

void walk_intensity(uint i, uint particle, float scale) {
  Share share = share_of(particle, 4u);
  Words4 words = keyed_words(pass.key, share.item, kIntensityDraw);
  uint pair = share.part & ~1u;
  NormalPair n = normals_of(words.w[pair], words.w[pair + 1u]);
  float low = pass.intensity_low, high = pass.intensity_high;
  precise float value = intensities[i] + pass.intensity_deviation * scale *
                        ((share.part & 1u) == 0u ? n.n0 : n.n1);
  if (value < low) value = 2.0 * low - value;
  if (value > high) value = 2.0 * high - value;
  intensities[i] = min(max(value, low), high);
}

void move() {
  uint i = item(), particle = pass.first + i;
  if (i >= pass.count) return;
  uint mode = 0u;
  if (pass.modes > 1u) {
    mode = switched(particle, modes[i]);
    modes[i] = mode;
  }
  MoveTerms m = pass.move[mode];
  float scale = pass.scaled != 0u ? scales[i] : 1.0;
  Words4 words = keyed_words(pass.key, particle, 0u);
  NormalPair nx = normals_of(words.w[0], words.w[1]), ny = normals_of(words.w[2], words.w[3]);
  NormalPair third = NormalPair(0.0, 0.0);
  if (m.time != 0.0) third = third_noise(particle);
  bool accelerates = pass.accelerates != 0u;
  Axis x = Axis(xs[i], vxs[i], accelerates ? axs[i] : 0.0);
  Axis y = Axis(ys[i], vys[i], accelerates ? ays[i] : 0.0);
  Axis x_moved = moved(x, m, -1.0, y.v, Noise(scale * nx.n0, scale * nx.n1, scale * third.n0));
  Axis y_moved = moved(y, m, 1.0, x.v, Noise(scale * ny.n0, scale * ny.n1, scale * third.n1));
  xs[i] = x_moved.x, vxs[i] = x_moved.v;
  ys[i] = y_moved.x, vys[i] = y_moved.v;
  if (m.time != 0.0) axs[i] = x_moved.a, ays[i] = y_moved.a;
  walk_intensity(i, particle, scale);
}
