// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <vector>

#include "glint/kernels/prepare_frame/whiten.hpp"

namespace glint::prepare_frame {

/// Known residuals on the grid of RobustSpread; returns their number. `residuals` may be longer.
inline int gather_residuals(const RobustSpread::Args& args, std::vector<float>& residuals) {
  residuals.resize(RobustSpread::kSamples + 1);
  const int step = RobustSpread::step(args.image.width, args.image.height);
  int n = 0;
  for (int y = 0; y < args.image.height; y += step) {
    const float* image = args.image.row(y);
    const float* background = args.background.empty() ? nullptr : args.background.row(y);
    for (int x = 0; x < args.image.width; x += step) {
      const float r = image[x] - (background == nullptr ? 0 : background[x]);
      residuals[static_cast<std::size_t>(n)] = r;
      n += std::isnan(r) ? 0 : 1;
    }
  }
  return n;
}

}  // namespace glint::prepare_frame
