// SPDX-License-Identifier: Apache-2.0
// What a pixel shows by the rule of a `band`, which, with `boxes`, the including file has.
bool is_lit(float pixel) {
  bool finite = (floatBitsToUint(pixel) & 0x7f800000u) != 0x7f800000u;
  return finite && pixel > band.threshold;
}

// z, 0 for a dark pixel.
float intensity(float pixel) {
  precise float z = pixel - band.offset;
  return is_lit(pixel) ? z : 0.0;
}

bool is_missing(float pixel, int x, int y) {
  bool missing = band.truncate_dark != 0u && !is_lit(pixel);
  for (uint i = 0u; i < band.boxes; ++i) {
    ivec4 box = boxes[i];
    missing = missing || (x >= box.x && x < box.z && y >= box.y && y < box.w);
  }
  return missing;
}
