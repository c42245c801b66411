// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "glint/engine/scenario/scenario.hpp"
#include "glint/engine/trackers/registry.hpp"
#include "glint/kernels/core/device.hpp"

namespace glint {

/// What a tracker with its default settings says of a scene that goes through the whole engine.
TrackLog track_log(const TrackerEntry& tracker, const Scene& scene, std::uint64_t seed,
                   const Device& device);

/// How the log of one device compares with that of the first.
struct LogParityRow {
  std::string tracker, scene, device;
  std::size_t points = 0;            ///< reported online
  std::size_t first_other_line = 0;  ///< of TrackLog::text(), from 1; 0 means the same bytes

  bool ok() const { return points > 0 && first_other_line == 0; }
};

/// One row a device; an empty log fails, for it proves nothing.
std::vector<LogParityRow> check_log_parity(const TrackerEntry& tracker, const Scene& scene,
                                           std::uint64_t seed, std::span<const Device> devices);

/// First line, from 1, in which two texts differ; 0 if they are the same bytes.
std::size_t first_other_line(const std::string& a, const std::string& b);

}  // namespace glint
