// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/engine/metrics/metrics.hpp"
#include "glint/engine/scenario/silhouette.hpp"

namespace glint {

/// Whether an estimate lies on the target, P-HPMHT section 4: the target covers at least half of
/// the pixel there.
bool hits(const Position& estimate, const Patch& target);

}  // namespace glint
