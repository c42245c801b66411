// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstddef>

namespace glint {

/// Splits `count` items into fixed tiles of `size`; the last one may be shorter. The only place
/// that splits work: a tile is a function of the problem, never of the threads.
struct Tiles {
  std::size_t count = 0, size = 1;

  std::size_t tiles() const { return (count + size - 1) / size; }
  std::size_t begin(std::size_t tile) const { return tile * size; }
  std::size_t end(std::size_t tile) const { return std::min(count, (tile + 1) * size); }
};

/// Particles a tile: about 20 us of the cheapest kernel, small enough to stay in the first caches.
inline constexpr std::size_t kParticleTile = 4096;
/// Rows a tile of full-frame kernels.
inline constexpr std::size_t kRowTile = 64;

}  // namespace glint
