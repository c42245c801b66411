// SPDX-License-Identifier: Apache-2.0
// Floats as unsigned numbers of the same order; NaN is the last of them.
const uint kNoKey = 0xffffffffu;

bool is_nan(float x) { return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u; }

uint key_of(float x) {
  uint bits = floatBitsToUint(x);
  uint key = (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
  return is_nan(x) ? kNoKey : key;
}
float value_of(uint key) {
  return uintBitsToFloat((key & 0x80000000u) != 0u ? key ^ 0x80000000u : ~key);
}
