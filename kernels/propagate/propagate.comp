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
layout(std430, binding = 1) buffer State { uint state[]; };

float get(uint array, uint i) { return uintBitsToFloat(state[array * pass.count + i]); }
void set(uint array, uint i, float value) {
  state[array * pass.count + i] = floatBitsToUint(value);
}

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

// One axis: x' = x + along v -+ across v_other + half a + noise, likewise v and a.
void move_axis(uint i, MoveTerms m, float turn, uint x, float v, float other, uint vx, uint ax,
               Noise n) {
  float a = pass.accelerates != 0u ? get(ax, i) : 0.0;
  precise float step = m.along * v + turn * m.across * other + m.half_square * a +
                       m.xx * n.position;
  set(x, i, get(x, i) + step);
  precise float velocity = m.cosine * v + turn * m.sine * other + m.time * a + m.vx * n.position +
                           m.vv * n.velocity;
  set(vx, i, velocity);
  if (m.time == 0.0) return;
  precise float change = m.ax * n.position + m.av * n.velocity + m.aa * n.acceleration;
  set(ax, i, a + change);
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
  precise float value = get(kIntensity, i) + pass.intensity_deviation * scale *
                        ((share.part & 1u) == 0u ? n.n0 : n.n1);
  if (value < low) value = 2.0 * low - value;
  if (value > high) value = 2.0 * high - value;
  set(kIntensity, i, min(max(value, low), high));
}

void move() {
  uint i = item(), particle = pass.first + i;
  if (i >= pass.count) return;
  uint mode = 0u;
  if (pass.modes > 1u) {
    mode = switched(particle, state[kMode * pass.count + i]);
    state[kMode * pass.count + i] = mode;
  }
  MoveTerms m = pass.move[mode];
  float scale = pass.scaled != 0u ? get(kScale, i) : 1.0;
  Words4 words = keyed_words(pass.key, particle, 0u);
  NormalPair nx = normals_of(words.w[0], words.w[1]), ny = normals_of(words.w[2], words.w[3]);
  NormalPair third = NormalPair(0.0, 0.0);
  if (m.time != 0.0) third = third_noise(particle);
  float vx = get(kVx, i), vy = get(kVy, i);
  Noise x = Noise(scale * nx.n0, scale * nx.n1, scale * third.n0);
  Noise y = Noise(scale * ny.n0, scale * ny.n1, scale * third.n1);
  move_axis(i, m, -1.0, kX, vx, vy, kVx, kAx, x);
  move_axis(i, m, 1.0, kY, vy, vx, kVy, kAy, y);
  walk_intensity(i, particle, scale);
}
