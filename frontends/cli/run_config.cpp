// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/cli/run_config.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "glint/engine/frame_preparer.hpp"
#include "glint/engine/points.hpp"
#include "glint/engine/scenario/scenario.hpp"
#include "glint/engine/trackers/registry.hpp"
#include "glint/frontends/config/profiles.hpp"
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

void describe(FieldList& list, RunConfig& c) {
  constexpr int kMax = std::numeric_limits<int>::max();
  list("tracker", c.tracker, {}, "names of the trackers, separated by spaces");
  list("device", c.device, {}, "where kernels run: auto, serial or tbb");
  list("threads", c.threads, 0, 1024, "", "0 = all of the machine's");
  list("seed", c.seed, 0, kMax, "", "of all random numbers");
  list("add_noise", c.add_noise, 0, 1e6, "grey levels",
       "sigma of white Gaussian noise added to every frame, for trials");
  list("fps", c.fps, 0, 1e6, "frames/s", "frame rate; 0 = the input's own");
  list("mask", c.mask, {}, "image of the frames' size; pixels that are not 0 are ignored");
  list("format", c.format, {},
       "of frames without a header: gray8, gray16le or grayf32le; empty = files that say it");
  list("size", c.size, {}, "of frames without a header, e.g. 640x512 [px]");
  list("keep", c.keep, 0, kMax, "frames",
       "of tracks that are held in memory until the end, for late corrections; 0 = all: set it for "
       "streams without an end");
  list("points", c.points, {},
       "file of points (.csv, .jsonl) that go with the frames, instead of those found in them");
}

std::vector<ConfigSection> all_sections() {
  std::vector<ConfigSection> sections{ConfigSection::of<RunConfig>("run"),
                                      ConfigSection::of<FramesConfig>("frames"),
                                      ConfigSection::of<PointsConfig>("points")};
  for (const TrackerEntry& tracker : all_trackers()) sections.push_back(tracker.config());
  for (const SceneEntry& scene : all_scenes()) sections.push_back(scene.config());
  return sections;
}

ConfigSection section_named(std::span<const ConfigSection> sections, const std::string& name) {
  const auto found = std::ranges::find(sections, name, &ConfigSection::name);
  if (found == sections.end()) throw std::logic_error("no section " + name);
  return *found;
}

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

std::string bare_toml(std::span<const ConfigSection> sections) {
  std::string text;
  for (const ConfigSection& section : sections) {
    text += '[' + section.name() + "]\n";
    for (const ConfigField& field : section.fields()) {
      text += field.key + " = " + to_toml(field) + '\n';
    }
  }
  return text;
}

}  // namespace glint::cli
