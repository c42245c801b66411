// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "glint/engine/trackers/phd/peaks.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {

/// Splits particles into round(total mass) classes by k-means on position, as printed in P-PHD
/// section 3.1; for comparison with PeakFinder. `members` is filled with particle indices class by
/// class: those of a peak are members[first, last).
std::vector<Peak> kmeans_states(const Particles& particles, RandomKey key,
                                std::vector<std::uint32_t>& members);

}  // namespace glint
