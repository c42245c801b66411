// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "glint/engine/config.hpp"
#include "glint/engine/tracks/tracker.hpp"
#include "glint/kernels/core/device.hpp"

namespace glint {

/// How a tracker is found by name, configured and made.
struct TrackerEntry {
  std::string_view name, summary;
  Feed feed;  ///< that of the tracker made
  ConfigSection (*section)(std::string section_name);
  /// `config` is a section that `config()` made. Throws ConfigError for settings that do not fit
  /// together.
  std::unique_ptr<Tracker> (*make)(const ConfigSection& config, const Device& device,
                                   std::uint64_t seed);

  /// Its defaults, section "trackers.<name>".
  ConfigSection config() const { return section("trackers." + std::string(name)); }
};

/// The one list of trackers.
std::span<const TrackerEntry> all_trackers();
/// Throws ConfigError that lists the names if there is no such tracker.
const TrackerEntry& find_tracker(std::string_view name);

}  // namespace glint
