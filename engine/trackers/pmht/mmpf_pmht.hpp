// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/engine/trackers/pmht/particle_bank.hpp"
#include "glint/engine/trackers/pmht/pmht.hpp"

namespace glint {

/// Settings of `mmpf-pmht`.
struct MmpfPmhtConfig : PmhtConfig {
  MmpfPmhtConfig() {
    stay = 0.998;
    association = PmhtAssociation::mixture;
    iterations = 20, tolerance = 1e-2;
  }
  int particles = 200;  ///< of each model
};
void describe(FieldList& f, MmpfPmhtConfig& c);

/// Multiple-model particle filter a target, whose points are told by PMHT: P-MMPF with the
/// corrections of docs/trackers/mmpf-pmht.md.
extern template class PmhtTracker<MmpfPmhtConfig, ParticleBank>;
using MmpfPmht = PmhtTracker<MmpfPmhtConfig, ParticleBank>;

}  // namespace glint
