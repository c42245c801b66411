// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string_view>
#include <vector>

#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/random.hpp"
#include "glint/kernels/core/trial.hpp"

namespace glint {

/// Adds white Gaussian noise to an image: pixel p, counted row by row, gets sigma times normal
/// p % 4 of item p / 4.
struct AddNoise {
  static constexpr std::string_view name = "add_noise";
  static constexpr Tolerance tolerance{1e-6, 1e-6};

  struct Args {
    ImageView<float> image;
    float sigma = 1;  ///< in the units of the pixels
    RandomKey key;
  };
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
  static std::vector<std::unique_ptr<Trial>> trials();
};

}  // namespace glint
