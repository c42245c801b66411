// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/engine/trackers/jpda/imm_jpda.hpp"

namespace glint {

/// A tracker of the imm-jpda family under the name of an experiment's rows.
struct JpdaReading {
  const char* name;
  int window;  ///< scans
  WindowReading reading;
};

/// For boats seen by a radar good to 5 m, in metres and seconds: two constant velocities, one that
/// hardly changes and one that turns.
ImmJpdaConfig boat_tracker(const JpdaReading& reading);

}  // namespace glint
