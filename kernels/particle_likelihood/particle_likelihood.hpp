// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/point_spread.hpp"
#include "glint/kernels/core/random.hpp"
#include "glint/kernels/core/trial.hpp"

namespace glint {

/// Log-likelihood ratio of each particle: the exact pixel-integrated point spread over the window
/// around the pixel that holds it. P-PHD (13), (18). Windows are clipped at the border, not
/// renormalised; a particle outside the frame (x < -.5 or x >= width - .5, likewise y) or with a
/// non-finite position or intensity gets -infinity. The pixel that holds x is floor(x + .5), in
/// reference and fast path alike.
struct ParticleLikelihood {
  static constexpr std::string_view name = "particle_likelihood";
  /// Polynomial fit of the weights (1e-5 a pixel at I = 10) plus float sums.
  static constexpr Tolerance tolerance{1e-4, 1e-5};

  struct Args {
    FrameView frame;  ///< z, unit noise; has an Image's zero margin around it
    PointSpread spread = {};
    std::span<const float> x, y;       ///< [px]
    std::span<const float> intensity;  ///< [noise sigmas]
    std::span<float> log_ratio;        ///< written; all spans have one length
    float jitter =
        0;  ///< standard deviation of the sensor's position error u_k, P-PHD (3) [px]; sampled
            ///< per particle from normals 0 and 1 of (key, particle), in float everywhere
    RandomKey key = {};
  };
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
  static std::vector<std::unique_ptr<Trial>> trials();
};

}  // namespace glint
