// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>

#include "glint/kernels/core/isa.hpp"
#include "glint/kernels/core/point_spread.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {

/// Terms of a polynomial in the squared offset: of usual spreads, of narrow ones.
inline constexpr int kFewTerms = 5;
inline constexpr int kMaxTerms = 8;

/// The point spread's weights as polynomials in the sub-pixel offset f, z = f^2: the pixels k and
/// -k away from the particle's weigh even[k](z) +- f odd[k](z).
struct WeightPolynomials {
  int terms = 0;  ///< kFewTerms or kMaxTerms, one fewer of `odd`; 0: too narrow for a polynomial
  float even[kMaxHalfWidth + 1][kMaxTerms] = {};
  float odd[kMaxHalfWidth + 1][kMaxTerms] = {};
  float scale = 0;  ///< 1 / (sqrt 2 sigma)
};

/// One call's work, as all its tiles see it.
struct ParticlePass {
  const float* frame;
  std::ptrdiff_t pitch;
  int width, height;
  const float *x, *y, *intensity;
  float* log_ratio;
  float jitter;
  RandomKey key;
  WeightPolynomials weights;
};

/// Does particles [begin, end).
using ParticleRange = void (*)(const ParticlePass&, std::size_t begin, std::size_t end);

struct ParticleLikelihoodLanes {
  ParticleRange range[kMaxHalfWidth + 1];  ///< by half width
};
GLINT_DECLARE_LANES(ParticleLikelihoodLanes, particle_likelihood_lanes)

}  // namespace glint
