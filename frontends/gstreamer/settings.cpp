// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/gstreamer/settings.hpp"

#include <algorithm>
#include <span>
#include <sstream>

#include "glint/frontends/config/profiles.hpp"
#include "glint/frontends/config/run_config.hpp"
#include "glint/frontends/config/toml.hpp"

namespace glint::gstreamer {
namespace {

std::string trimmed(const std::string& text) {
  constexpr const char* kBlank = " \t\n\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

bool is_full_key(const std::string& key, std::span<const ConfigSection> sections) {
  return std::ranges::any_of(sections, [&](const ConfigSection& s) {
    return std::ranges::any_of(s.fields(),
                               [&](const ConfigField& f) { return s.name() + '.' + f.key == key; });
  });
}

/// Short keys are looked for among the settings that the run reads.
void set_all(const std::string& assignments, std::span<ConfigSection> all) {
  const RunConfig run = section_named(all, "run").as<RunConfig>();
  std::vector<ConfigSection> used = used_sections(all, trackers_of(run));
  std::istringstream list(assignments);
  for (std::string item; std::getline(list, item, ';');) {
    item = trimmed(item);
    if (item.empty()) continue;
    const bool full = is_full_key(trimmed(item.substr(0, item.find('='))), all);
    apply_set(item, full ? all : std::span(used));
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
  return all;
}

}  // namespace glint::gstreamer
