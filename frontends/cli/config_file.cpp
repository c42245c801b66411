// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/cli/config_file.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "glint/engine/profiles.hpp"
#include "glint/frontends/config/toml.hpp"
#include "glint/frontends/files/track_file.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint::cli {
namespace {

/// The configuration in a track file's header; every other line is left empty, so that errors name
/// the right one.
std::string config_of_track_file(std::ifstream& file) {
  std::string text;
  for (std::string line; std::getline(file, line); text += '\n') {
    if (line.starts_with('#')) text += line.substr(1);
  }
  return text;
}

/// The configuration in the first line of tracks as JSON lines.
std::string config_of_json(const std::string& line, const std::string& path) {
  const auto run = nlohmann::json::parse(line, nullptr, false);
  const auto config = run.is_object() ? run.find("config") : run.end();
  if (config == run.end() || !config->is_string()) {
    throw UsageError(path +
                     ": its first line holds no configuration of a run; give a .jsonl that "
                     "glint track wrote, or a TOML file");
  }
  return config->get<std::string>();
}

}  // namespace

void read_config(const std::string& path, std::span<ConfigSection> sections) {
  if (path.ends_with(".txt") && std::ifstream(sidecar_path(path))) {
    return read_toml(sidecar_path(path), sections);
  }
  std::ifstream file(path);
  std::string first;
  std::getline(file, first);
  if (first.starts_with('{')) return parse_toml(config_of_json(first, path), path, sections);
  if (!first.starts_with("##")) return read_toml(path, sections);
  file.seekg(0);
  parse_toml(config_of_track_file(file), path, sections);
}

std::string profile_help() {
  std::string help = "settings that go together, before --config and --set";
  for (const Profile& profile : all_profiles()) {
    help += "; " + std::string(profile.name) + ": " + std::string(profile.summary);
  }
  return help;
}

}  // namespace glint::cli
