// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/python/settings.hpp"

#include <algorithm>
#include <span>

#include "glint/engine/scenario/scenario.hpp"
#include "glint/frontends/config/profiles.hpp"
#include "glint/frontends/config/run_config.hpp"
#include "glint/frontends/config/settings.hpp"
#include "glint/frontends/config/toml.hpp"

namespace glint::python {
namespace {

bool names_tracker(const std::string& key) { return key == "run.tracker" || key == "tracker"; }

bool is_full_key(const std::string& key, std::span<const ConfigSection> sections) {
  return std::ranges::any_of(sections, [&](const ConfigSection& s) {
    return std::ranges::any_of(s.fields(),
                               [&](const ConfigField& f) { return s.name() + '.' + f.key == key; });
  });
}

/// Which trackers there are decides where short keys are looked for, so that comes first.
void set_all(const Values& values, std::span<ConfigSection> all) {
  for (const auto& [key, value] : values) {
    if (names_tracker(key)) apply_value("run.tracker", value, all);
  }
  const RunConfig run = section_named(all, "run").as<RunConfig>();
  std::vector<ConfigSection> used = used_sections(all, trackers_of(run));
  for (const auto& [key, value] : values) {
    const bool full = is_full_key(key, all);
    if (!names_tracker(key)) apply_value(key, value, full ? all : std::span(used));
  }
}

}  // namespace

std::vector<ConfigSection> sections_of(const Request& request) {
  std::vector<ConfigSection> all = all_sections();
  if (request.profile) apply_profile(*request.profile, all);
  parse_toml(request.config_text, "config", all);
  if (request.trackers) apply_value("run.tracker", *request.trackers, all);
  set_all(request.config, all);
  if (request.trackers) apply_value("run.tracker", *request.trackers, all);
  if (trackers_of(section_named(all, "run").as<RunConfig>()).empty()) {
    apply_value("run.tracker", std::string("mm-phd"), all);
  }
  set_all(request.settings, all);
  return all;
}

ConfigSection scene_section(const std::string& scene, const Values& values) {
  std::vector<ConfigSection> section{find_scene(scene).config()};
  for (const auto& [key, value] : values) apply_value(key, value, section);
  return section.front();
}

}  // namespace glint::python
