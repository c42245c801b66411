// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "glint/engine/config.hpp"
#include "glint/engine/settings.hpp"
#include "glint/engine/tracks/tracker.hpp"
#include "glint/kernels/core/device.hpp"

namespace glint {

/// `base` with `more` after it; of two settings of one key the later holds.
Settings operator+(Settings base, const Settings& more);

/// A tracker by its name in the registry, and how it departs from its defaults.
struct TrackerSetup {
  std::string tracker;
  Settings settings;

  /// Throws ConfigError for a tracker, key or value that is not known.
  ConfigSection config() const;
  std::unique_ptr<Tracker> make(const Device& device, std::uint64_t seed) const;
};

}  // namespace glint
