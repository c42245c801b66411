// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "glint/engine/profiles.hpp"
#include "glint/engine/run_config.hpp"
#include "glint/engine/trackers/registry.hpp"
#include "glint/frontends/cli/commands.hpp"
#include "glint/frontends/cli/config_file.hpp"
#include "glint/frontends/config/toml.hpp"

namespace glint::cli {
namespace {

/// False if there is no scene of that name.
bool print_scene(const std::string& name) {
  const std::vector<ConfigSection> all = all_sections();
  const auto scene = std::ranges::find(all, "scenes." + name, &ConfigSection::name);
  if (scene == all.end()) return false;
  fmt::print("{}", write_toml(std::span(&*scene, 1)));
  return true;
}

}  // namespace

void add_config(Command& program) {
  auto tracker = std::make_shared<std::string>();
  auto profile = std::make_shared<std::string>();
  Command command =
      program.subcommand("config", "A tracker's or a scene's whole configuration, as TOML");
  command.option("NAME", *tracker, "of a tracker or a scene, see glint info").required();
  command.option("--profile", *profile, profile_help());
  command.footer(
      "Example:\n"
      "  glint config smc-phd > my.toml; glint track clip.mp4 --config my.toml");
  command.callback([tracker, profile] {
    if (print_scene(*tracker)) return;
    const TrackerEntry& entry = find_tracker(*tracker);
    const std::string name(entry.name);
    auto all = all_sections();
    if (!profile->empty()) apply_profile(*profile, all);
    apply_set("run.tracker=" + name, all);
    std::vector sections{section_named(all, "run"), section_named(all, "frames")};
    if (entry.feed != Feed::frames) sections.push_back(section_named(all, "points"));
    sections.push_back(section_named(all, "trackers." + name));
    fmt::print("{}", write_toml(sections));
  });
}

}  // namespace glint::cli
