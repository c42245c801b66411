// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/trial.hpp"

namespace glint {

/// How much a pixel deserves births: exp(clamp(r, low, high) / 2), with r the log-likelihood ratio
/// of the pixel's best intensity in [intensity_low, intensity_high]. The square root flattens the
/// proposal, so that one bright pixel does not take all births; weights make up for it.
struct BirthScores {
  static constexpr std::string_view name = "birth_scores";
  static constexpr Tolerance tolerance{1e-6, 2e-5};

  struct Args {
    FrameView map;        ///< PixelLikelihood's map for `intensity`
    float intensity = 1;  ///< that the map was made for [noise sigmas]
    float energy = 1;     ///< sum of the window's squared weights, B
    float intensity_low = 1, intensity_high = 1;
    float low = -8, high = 20;         ///< clamp of the log ratio
    ImageView<float> score;            ///< written; size of the map
    std::span<const Box> masked = {};  ///< inside the map: scores there are 0
    std::span<double> row_sums = {};   ///< written if given, one a row: sum of its scores
  };
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
  static std::vector<std::unique_ptr<Trial>> trials();
};

}  // namespace glint
