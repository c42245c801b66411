// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/kernels/core/isa.hpp"
#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/resample/resample.hpp"
#include "glint/kernels/resample/shares.hpp"

namespace glint {
namespace resample {

/// Particles a block of sums, and offspring a unit of work at most: a block of heavy particles is
/// worked on in several units.
inline constexpr std::size_t kBlock = kParticleTile, kUnit = 2 * kParticleTile;

/// How weights become offspring, the same for all blocks.
struct Rule {
  Scale scale;
  Points points;
  bool splits = false;  ///< residual
  Splitter splitter;
};

/// Sums over whole numbers; exact.
struct Sums {
  std::int64_t copies = 0;  ///< residual only
  std::int64_t mass = 0;    ///< what the points are laid over
};

/// The offspring [begin, end) of one block of particles.
struct Unit {
  const float* weights;
  std::size_t first, count;  ///< of the block's particles
  Sums before;               ///< of all particles before the block
  std::int32_t begin, end;
  std::uint32_t* ancestors;
  const MovedArray* moved;
  std::size_t arrays;
};

/// How many offspring the particles with these sums have together.
GLINT_INLINE std::int32_t offspring(Sums sums, Points points) {
  return static_cast<std::int32_t>(sums.copies) + below(static_cast<double>(sums.mass), points);
}

}  // namespace resample

struct ResampleLanes {
  float (*largest)(const float* weights, std::size_t count);
  std::int64_t (*total)(const float* weights, std::size_t count, resample::Scale scale);
  resample::Sums (*split_totals)(const float* weights, std::size_t count,
                                 const resample::Rule& rule);
  void (*draw)(const resample::Rule& rule, const resample::Unit& unit);
};

GLINT_DECLARE_LANES(ResampleLanes, resample_lanes)

}  // namespace glint
