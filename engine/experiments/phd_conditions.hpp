// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "glint/engine/experiments/experiment.hpp"
#include "glint/engine/trackers/smc_phd.hpp"

namespace glint {

/// The levels of P-PHD table 1.
inline constexpr std::array kPhdSnr{12, 10, 8};  // [dB]
/// A band at each level, or none.
using PhdBands = std::array<std::optional<Band>, kPhdSnr.size()>;

/// What section 5.1 is run with: a tracker's settings, and what must come out.
struct PhdCondition {
  std::string name;
  SmcPhdConfig (*settings)(std::size_t level);
  bool has_target = true;
  PhdBands ospa{};      ///< while the target is present [px]
  PhdBands expected{};  ///< number of targets in the paper's frames 15 to 24
};

/// The one list of conditions; the bands are those that a right implementation attains.
std::vector<PhdCondition> phd_conditions();

}  // namespace glint
