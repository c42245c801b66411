// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/add_noise/lanes.hpp"

#include "glint/kernels/core/math.hpp"

namespace glint::GLINT_LANES {
namespace {

constexpr int kItems = 64;
constexpr int kBlock = 4 * kItems;  // pixels

void fill(float* __restrict noise, std::uint32_t first_item, RandomKey key) {
  alignas(64) float n[4][kItems];
  for (int j = 0; j < kItems; ++j) {
    const Normals4 four = random_normals(key, first_item + static_cast<std::uint32_t>(j));
    n[0][j] = four.n[0];
    n[1][j] = four.n[1];
    n[2][j] = four.n[2];
    n[3][j] = four.n[3];
  }
  for (int j = 0; j < kItems; ++j) {
    for (int k = 0; k < 4; ++k) noise[4 * j + k] = n[k][j];
  }
}

void row(float* values, int n, std::uint32_t pixel, float sigma, RandomKey key) {
  alignas(64) float noise[kBlock];
  int done = 0;
  while (done < n) {
    const std::uint32_t at = pixel + static_cast<std::uint32_t>(done);
    fill(noise, at / 4, key);
    const int skipped = static_cast<int>(at % 4);  // rows need not start at an item
    const int room = kBlock - skipped, left = n - done;
    const int count = room < left ? room : left;
    for (int i = 0; i < count; ++i) {
      values[done + i] = math::fma(sigma, noise[skipped + i], values[done + i]);
    }
    done += count;
  }
}

}  // namespace

extern const AddNoiseLanes add_noise_lanes;
const AddNoiseLanes add_noise_lanes{row};

}  // namespace glint::GLINT_LANES
