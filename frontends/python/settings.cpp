// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/python/settings.hpp"

#include <span>

#include "glint/engine/profiles.hpp"
#include "glint/engine/run_config.hpp"
#include "glint/engine/scenario/scenario.hpp"
#include "glint/engine/settings.hpp"
#include "glint/frontends/config/toml.hpp"

namespace glint::python {
namespace {

void set_all(const Values& values, std::span<ConfigSection> all) {
  Settings settings;
  for (const auto& [key, value] : values) settings.emplace_back(key, value);
  apply_settings(settings, all);
}

}  // namespace

std::vector<ConfigSection> sections_of(const Request& request) {
  std::vector<ConfigSection> all = all_sections();
  if (request.profile) apply_profile(*request.profile, all);
  parse_toml(request.config_text, "config", all);
  if (request.trackers) apply_value("run.tracker", *request.trackers, all);
  if (trackers_of(section_named(all, "run").as<RunConfig>()).empty()) {
    apply_value("run.tracker", std::string("mm-phd"), all);
  }
  set_all(request.config, all);
  if (request.trackers) apply_value("run.tracker", *request.trackers, all);
  set_all(request.settings, all);
  return all;
}

ConfigSection scene_section(const std::string& scene, const Values& values) {
  std::vector<ConfigSection> section{find_scene(scene).config()};
  for (const auto& [key, value] : values) apply_value(key, value, section);
  return section.front();
}

}  // namespace glint::python
