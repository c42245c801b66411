// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <limits>

#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/pixel_likelihood/check.hpp"
#include "glint/kernels/pixel_likelihood/lanes.hpp"

namespace glint {
namespace {

constexpr std::size_t kMaxTiles = 256;
/// Maps beyond this leave nothing in the last cache for a later reader: store them past it.
constexpr std::size_t kStreamBytes = std::size_t{32} << 20;
/// Room for hits in the first pass: one pixel in 64. More costs a second pass.
constexpr std::size_t kPixelsPerHit = 64;

bool worth_streaming(const ImageView<float>& map) {
  const auto bytes = static_cast<std::size_t>(map.height) * static_cast<std::size_t>(map.width) * 4;
  return bytes > kStreamBytes && reinterpret_cast<std::uintptr_t>(map.data) % 64 == 0 &&
         map.pitch % 16 == 0;
}

template <class T>
PixelPass<T> make_pass(const PixelLikelihood::Args& args, const ImageView<const T>& frame) {
  PixelPass<T> pass{};
  pass.frame = frame.data, pass.pitch = frame.pitch;
  pass.width = frame.width, pass.height = frame.height;
  pass.map = args.map.empty() ? nullptr : args.map.data;
  pass.map_pitch = args.map.pitch;
  pass.stream = worth_streaming(args.map);
  const double intensity = args.intensity, centre = args.spread.weight(0, 0);
  for (int k = 0; k <= args.spread.half_width; ++k) {
    const double weight = args.spread.weight(k, 0);
    pass.relative[k] = static_cast<float>(weight / centre);
    pass.squared[k] = static_cast<float>(weight * weight);
  }
  pass.offset = args.offset;
  pass.gain = static_cast<float>(intensity * args.scale * centre * centre);
  pass.energy_gain = static_cast<float>(-intensity * intensity / 2);
  pass.threshold = args.hits == nullptr ? std::numeric_limits<float>::infinity() : args.threshold;
  return pass;
}

/// Hits of each tile, counted.
struct HitCounts {
  std::array<std::size_t, kMaxTiles> of_tile{};
  std::size_t room = 0;  ///< a tile's, in the first pass
};

/// Moves the tiles' hits together; false if a tile had no room for all of its.
bool close_up(const HitCounts& counts, std::size_t tiles, std::vector<Hit>& hits) {
  std::size_t total = 0;
  bool all = true;
  for (std::size_t t = 0; t < tiles; ++t) {
    all = all && counts.of_tile[t] <= counts.room;
    if (all && t * counts.room != total) {
      const auto first = hits.begin() + static_cast<std::ptrdiff_t>(t * counts.room);
      std::copy_n(first, counts.of_tile[t], hits.begin() + static_cast<std::ptrdiff_t>(total));
    }
    total += counts.of_tile[t];
  }
  hits.resize(total);
  return all;
}

template <class T>
void scan(PixelPass<T> pass, PixelRows<T> rows, std::vector<Hit>* hits, Workers& workers) {
  const auto height = static_cast<std::size_t>(pass.height);
  const std::size_t size = (height / (kMaxTiles * kRowTile) + 1) * kRowTile;
  const Tiles tiles{height, size};
  HitCounts counts;
  if (hits != nullptr) {
    counts.room = size * static_cast<std::size_t>(pass.width) / kPixelsPerHit;
    hits->resize(tiles.tiles() * counts.room);
  }
  const auto run = [&](std::size_t t, Hit* out, std::size_t room) {
    return rows(pass, static_cast<int>(tiles.begin(t)), static_cast<int>(tiles.end(t)), out, room);
  };
  workers.for_tiles(tiles.tiles(), [&](std::size_t t) {
    Hit* out = hits == nullptr ? nullptr : hits->data() + t * counts.room;
    counts.of_tile[t] = run(t, out, counts.room);
  });
  if (hits == nullptr || close_up(counts, tiles.tiles(), *hits)) return;
  pass.map = nullptr;
  workers.for_tiles(tiles.tiles(), [&](std::size_t t) {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < t; ++i) begin += counts.of_tile[i];
    run(t, hits->data() + begin, counts.of_tile[t]);
  });
}

}  // namespace

void PixelLikelihood::tbb(const Args& args, Workers& workers) {
  pixel_likelihood::check(args);
  const auto& lanes = pixel_likelihood_lanes(workers.isa());
  const auto half = static_cast<std::size_t>(args.spread.half_width);
  if (const auto* frame = std::get_if<ImageView<const float>>(&args.frame)) {
    scan(make_pass(args, *frame), lanes.float_rows[half], args.hits, workers);
  } else {
    const auto& raw = std::get<ImageView<const std::uint16_t>>(args.frame);
    scan(make_pass(args, raw), lanes.uint16_rows[half], args.hits, workers);
  }
}

}  // namespace glint
