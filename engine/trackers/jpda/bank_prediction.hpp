// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <variant>

#include "glint/engine/filters/imm.hpp"
#include "glint/engine/filters/short_list.hpp"
#include "glint/engine/trackers/jpda/measurement_prediction.hpp"

namespace glint {

/// The measurement that a motion model expects of a state of N numbers.
template <class Sensor, int N>
using ModelPrediction = MeasurementPrediction<N, Sensor::kSize, Sensor::kAzimuth>;

/// The measurements that the motion models of a bank expect, in their order: models have two or
/// three numbers an axis.
template <class Sensor>
using BankPrediction = ShortList<std::variant<ModelPrediction<Sensor, 2 * Sensor::kAxes>,
                                              ModelPrediction<Sensor, 3 * Sensor::kAxes>>,
                                 kMostModes>;

/// P-JPDA (22), (23). `bank` is predicted to the time of the scan.
template <class Sensor>
BankPrediction<Sensor> predict_measurements(const ImmOf<Sensor::kAxes>& bank, const Sensor& sensor,
                                            Linearisation how) {
  BankPrediction<Sensor> expected;
  for (const auto& any : bank.modes()) {
    std::visit(
        [&](const auto& mode) {
          expected.push_back(predict_measurement(mode.belief, sensor, how));
        },
        any);
  }
  return expected;
}

}  // namespace glint
