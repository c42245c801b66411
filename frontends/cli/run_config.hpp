// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string>
#include <vector>

#include "glint/engine/config.hpp"

namespace glint::cli {

/// What a run is told besides its inputs and the settings of frames and trackers; the file section
/// [run]. Options such as --seed are short for --set run.seed=...
struct RunConfig {
  std::string tracker;  ///< names, separated by spaces
  std::string device = "auto";
  int threads = 0;
  int seed = 1;
  double add_noise = 0;  ///< [grey levels]
  double fps = 0;        ///< [1/s]; 0 = the input's own
  std::string mask;
  std::string format, size;  ///< of raw frames; empty = inputs have headers
  int keep = 0;              ///< [frames]; 0 = all
  std::string points;        ///< a file of points that go with the frames
};
void describe(FieldList& list, RunConfig& config);

/// All sections that a configuration file may have: run, frames, points, every tracker, every
/// scene.
std::vector<ConfigSection> all_sections();

/// The section of that name. Copies of a section share its settings.
ConfigSection section_named(std::span<const ConfigSection> sections, const std::string& name);

/// Sets what a file says: TOML, or a track file of any format, whose header or sidecar holds the
/// configuration of the run that wrote it. Throws as read_toml() does.
void read_config(const std::string& path, std::span<ConfigSection> sections);

/// What --profile takes: the names, and what each is for.
std::string profile_help();

/// Settings as TOML without help texts.
std::string bare_toml(std::span<const ConfigSection> sections);

}  // namespace glint::cli
