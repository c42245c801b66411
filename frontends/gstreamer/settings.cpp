// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/gstreamer/settings.hpp"

#include <span>
#include <sstream>
#include <string_view>

#include "glint/engine/frames/frames_config.hpp"
#include "glint/engine/profiles.hpp"
#include "glint/engine/run_config.hpp"
#include "glint/engine/trimmed.hpp"
#include "glint/frontends/config/toml.hpp"

namespace glint::gstreamer {
namespace {

/// Short keys are looked for among the settings that the run reads.
void set_all(const std::string& assignments, std::span<ConfigSection> all) {
  std::istringstream list(assignments);
  for (std::string item; std::getline(list, item, ';');) {
    const std::string_view setting = trimmed(item);
    if (setting.empty()) continue;
    std::vector<ConfigSection> read =
        sections_with(trimmed(setting.substr(0, setting.find('='))), all);
    apply_set(setting, read);
  }
}

}  // namespace

std::vector<ConfigSection> sections_of(const Properties& properties) {
  std::vector<ConfigSection> all = all_sections();
  if (!properties.profile.empty()) apply_profile(properties.profile, all);
  if (!properties.config_file.empty()) read_toml(properties.config_file, all);
  parse_toml(properties.config, "config", all);
  if (!properties.tracker.empty()) apply_value("run.tracker", properties.tracker, all);
  if (!properties.device.empty()) apply_value("run.device", properties.device, all);
  if (trackers_of(section_named(all, "run").as<RunConfig>()).empty()) {
    apply_value("run.tracker", std::string("mm-phd"), all);
  }
  set_all(properties.set, all);
  if (section_named(all, "frames").as<FramesConfig>().background_prime > 0) {
    throw ConfigError(
        "frames.background_prime holds frames back, and here each picture leaves with its own "
        "tracks; leave it out, or track the file by `glint track`");
  }
  return all;
}

}  // namespace glint::gstreamer
