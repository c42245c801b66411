// SPDX-License-Identifier: Apache-2.0
#include "glint/experiments/tracker_setup.hpp"

#include <algorithm>

#include "glint/engine/trackers/registry.hpp"

namespace glint {

Settings operator+(Settings base, const Settings& more) {
  base.insert(base.end(), more.begin(), more.end());
  return base;
}

ConfigSection TrackerSetup::config() const {
  ConfigSection section = find_tracker(tracker).config();
  for (const Setting& setting : settings) {
    const auto field = std::ranges::find(section.fields(), setting.key, &ConfigField::key);
    if (field == section.fields().end()) {
      throw ConfigError("tracker " + tracker + " has no setting '" + setting.key + "'");
    }
    assign(*field, setting.value);
  }
  return section;
}

std::unique_ptr<Tracker> TrackerSetup::make(const Device& device, std::uint64_t seed) const {
  return find_tracker(tracker).make(config(), device, seed);
}

}  // namespace glint
