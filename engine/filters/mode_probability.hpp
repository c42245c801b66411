// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>

#include "glint/engine/filters/short_list.hpp"

namespace glint {

/// Most motion models that a track may have.
inline constexpr std::size_t kMostModes = 8;

/// Probabilities of a track's motion models, in their order.
using ModeProbability = ShortList<double, kMostModes>;

}  // namespace glint
