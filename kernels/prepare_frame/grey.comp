// SPDX-License-Identifier: Apache-2.0
// Raw pixels, which lie in words, to grey. P-HPMHT (1), (2)
#include "glint/kernels/core/prelude.glsl"
#include "glint/kernels/core/glsl.glsl"
#include "glint/kernels/prepare_frame/pass.glsl"

layout(std430, binding = 0) readonly buffer Parameters { GreyBand band; };
layout(std430, binding = 1) readonly buffer Raw { uint raw[]; };
layout(std430, binding = 2) writeonly buffer Grey { float grey[]; };
layout(std430, binding = 3) writeonly buffer Masked { uint masked; };

float channel(uint i) {
  if (band.bytes == 4u) return uintBitsToFloat(raw[i]);
  uint in_word = 4u / band.bytes, bits = 8u * band.bytes;
  return float(bitfieldExtract(raw[i / in_word], int(i % in_word * bits), int(bits)));
}

void to_grey() {
  uint i = item(), at = i * band.channels;
  if (i >= band.pixels) return;
  precise float value = channel(at);
  if (band.channels != 1u) {
    precise float blue = 0.114 * value;
    value = fma(0.2989, channel(at + 2u), fma(0.587, channel(at + 1u), blue));
  }
  bool good = (floatBitsToUint(value) & 0x7fffffffu) <= floatBitsToUint(band.largest);
  if (!good) masked = 1u;  // whoever writes it writes the same
  precise float inverse = 255.0 / max(value, band.reciprocal_floor);
  float result = band.reciprocal != 0u ? inverse : value;
  grey[i] = good ? result : uintBitsToFloat(0x7fc00000u);
}
