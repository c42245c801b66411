// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "glint/engine/config.hpp"
#include "glint/engine/scheduler.hpp"
#include "glint/engine/settings.hpp"

namespace glint {

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
  std::string start_at;      ///< a file of targets that tracks start on
};
void describe(FieldList& list, RunConfig& config);

/// Their names. Throws ConfigError for one that is given twice: two of one name would share their
/// settings and write over each other's tracks.
std::vector<std::string> trackers_of(const RunConfig& run);

/// All sections that a configuration file may have: run, frames, points, every tracker, every
/// scene.
std::vector<ConfigSection> all_sections();

/// The section of that name. Copies of a section share its settings.
ConfigSection section_named(std::span<const ConfigSection> sections, const std::string& name);

/// The sections that a run with these trackers reads: run, frames, points if a tracker feeds on
/// them, each tracker's own, then those that `more` names. Throws ConfigError for a tracker that is
/// none.
std::vector<ConfigSection> used_sections(std::span<const ConfigSection> all,
                                         std::span<const std::string> trackers,
                                         std::span<const std::string> more = {});

/// Those that the run of section [run] reads, where a key of one of its settings is looked for.
/// Throws ConfigError for the full key of a setting that it does not read, such as one of another
/// tracker.
std::vector<ConfigSection> sections_with(std::string_view key, std::span<const ConfigSection> all);

/// Sets them among all sections: run.tracker first, since short keys are looked for in the sections
/// that its trackers read, then the profile ("profile" = "P" or "L"), then the rest in their order.
/// Throws ConfigError for an unknown or ambiguous key, a value that its field refuses, and a key
/// that the run does not read, such as one of another tracker.
void apply_settings(const Settings& settings, std::span<ConfigSection> all);

/// Adds the trackers of the section [run], each made of its own section. Throws ConfigError for a
/// name that is none, and what a tracker throws for its settings.
void add_trackers(Scheduler& scheduler, std::span<const ConfigSection> sections,
                  const Device& device);

/// What programs that push frames track them with. Throws ConfigError for settings of [run] that
/// only the command line has a use for, and if no tracker is named; else as add_trackers() does.
Scheduler pushed_frames_scheduler(std::span<const ConfigSection> sections);

/// The same from settings over the defaults; see apply_settings(). `trackers` are names, separated
/// by spaces.
Scheduler scheduler_of(std::string_view trackers, const Settings& settings);

/// Settings as TOML without help texts.
std::string bare_toml(std::span<const ConfigSection> sections);

}  // namespace glint
