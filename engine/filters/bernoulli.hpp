// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace glint {

/// Existence probability of one target after a frame: W = survival r before it, odds W / (1 - W) L
/// after it. `ratio`: L, the frame's likelihood ratio; 0 ends all hope. The Bernoulli filter's
/// update. P-PHD (14), (19) have the odds W L, a PHD's: with r at most 1 they forget by how much a
/// target was seen before.
double bernoulli_update(double existence, double survival, double ratio);

/// The frame's likelihood ratio in the mass of one target's particles after a PHD filter's update,
/// which is W L / (1 + W L) by P-PHD (14); `before`: their mass after the last update.
double ratio_of_mass(double mass, double before, double survival);

}  // namespace glint
