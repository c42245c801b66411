// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/engine/trackers/jpda/jpda.hpp"
#include "glint/engine/trackers/jpda/measurement_prediction.hpp"
#include "glint/engine/trackers/jpda/multiscan_jpda.hpp"

namespace glint {

/// How a window of several scans is used (docs/trackers/imm-jpda.md).
enum class WindowReading {
  restart,  ///< A: all scans are filtered anew at every scan, from the estimate before; as printed
  sliding,  ///< C: weighted by what was likely in all earlier scans; the oldest scan is merged
  best,     ///< C*: sliding, and only the best permutation of each set of targets and points counts
};

/// Settings of the association of points and targets.
struct ImmWindowConfig {
  int window = 1;  ///< scans that are associated together, 1 to 3; 1 is IMM-JPDA
  WindowReading reading = WindowReading::best;
  double detection = 0.9;  ///< P_D
  double gate = 13.8;      ///< squared distance, gamma; 13.8 holds 99.9 % of two numbers
  JpdaClutter::Number clutter = JpdaClutter::Number::poisson;
  Linearisation linearisation = Linearisation::extended;  ///< of a measurement that is not linear
};

/// Of the joint events of the window.
inline MultiscanSettings multiscan_settings(const ImmWindowConfig& config) {
  if (config.window == 1) return MultiscanSettings::single_scan();
  MultiscanSettings settings;
  settings.best_permutation = config.reading == WindowReading::best;
  return settings;
}

}  // namespace glint
