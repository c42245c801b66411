// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/add_noise/add_noise.hpp"

namespace glint {

void AddNoise::serial(const Args& args) {
  Normals4 noise{};
  std::uint32_t pixel = 0;
  for (int y = 0; y < args.image.height; ++y) {
    for (int x = 0; x < args.image.width; ++x, ++pixel) {
      if (pixel % 4 == 0) noise = random_normals(args.key, pixel / 4);
      float& value = args.image(x, y);
      value = static_cast<float>(value + static_cast<double>(args.sigma) * noise.n[pixel % 4]);
    }
  }
}

}  // namespace glint
