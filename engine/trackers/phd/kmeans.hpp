// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "glint/engine/trackers/phd/peaks.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {

/// Splits a weighted cloud into round(total mass) classes by k-means on position, as printed in
/// P-PHD section 3.1; kept to show what it costs. `members` is filled class by class, as the peaks'
/// ranges say.
std::vector<Peak> kmeans_states(const Particles& particles, RandomKey key,
                                std::vector<std::uint32_t>& members);

}  // namespace glint
