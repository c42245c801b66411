// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/add_noise/add_noise.hpp"
#include "glint/kernels/add_noise/lanes.hpp"
#include "glint/kernels/core/tiles.hpp"

namespace glint {

void AddNoise::tbb(const Args& args, Workers& workers) {
  const ImageView<float> image = args.image;
  if (image.empty()) return;
  const auto& lanes = add_noise_lanes(workers.isa());
  const Tiles rows{static_cast<std::size_t>(image.height), kRowTile};
  workers.for_tiles(rows.tiles(), [&](std::size_t t) {
    for (auto y = static_cast<int>(rows.begin(t)); y < static_cast<int>(rows.end(t)); ++y) {
      const auto pixel = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(image.width);
      lanes.row(image.row(y), image.width, pixel, args.sigma, args.key);
    }
  });
}

}  // namespace glint
