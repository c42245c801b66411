// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/run_config.hpp"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "glint/engine/frames/frame_preparer.hpp"
#include "glint/engine/frames/point_finder.hpp"
#include "glint/engine/number_text.hpp"
#include "glint/engine/profiles.hpp"
#include "glint/engine/scenario/radar_scenes.hpp"
#include "glint/engine/scenario/scenario.hpp"
#include "glint/engine/trackers/registry.hpp"

namespace glint {

void describe(FieldList& list, RunConfig& c) {
  constexpr int kMax = std::numeric_limits<int>::max();
  list("tracker", c.tracker, {}, "names of the trackers, separated by spaces");
  list("device", c.device, {}, "where kernels run: auto, serial, tbb, egl or egl:N");
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
  list("start_at", c.start_at, {},
       "file of targets (.csv: frame or time, x, y, and vx, vy, sigma) that tracks start on");
}

namespace {

/// Settings that nothing would come of where a program pushes frames.
void refuse_what_reads_files(const RunConfig& run) {
  struct Refusal {
    bool given;
    const char *key, *remedy;
  };
  for (const Refusal& refusal : std::initializer_list<Refusal>{
           {run.fps != 0, "fps", "give each frame its time"},
           {!run.size.empty(), "size", "a frame says its size itself"},
           {!run.format.empty(), "format", "a frame says the type of its pixels itself"},
           {!run.mask.empty(), "mask", "set pixels to be ignored to NaN in float frames"},
           {!run.points.empty(), "points", "push the points"},
           {!run.start_at.empty(), "start_at", "call start() before the frame is pushed"},
           {run.add_noise != 0, "add_noise", "add noise before pushing"}}) {
    if (refusal.given) {
      throw ConfigError(std::string("run.") + refusal.key +
                        " has no effect on frames that are pushed: " + refusal.remedy);
    }
  }
}

bool has_full_key(const ConfigSection& section, std::string_view key) {
  return std::ranges::any_of(section.fields(), [&](const ConfigField& field) {
    return section.name() + '.' + field.key == key;
  });
}

bool has_full_key(std::span<const ConfigSection> sections, std::string_view key) {
  return std::ranges::any_of(sections, [&](const auto& s) { return has_full_key(s, key); });
}

bool names_trackers(const Setting& setting) {
  return setting.key == "tracker" || setting.key == "run.tracker";
}

const std::string& profile_of(const Setting& setting) {
  if (const auto* name = std::get_if<std::string>(&setting.value)) return *name;
  throw ConfigError("profile must be the name of one, in quotes");
}

}  // namespace

std::vector<std::string> trackers_of(const RunConfig& run) {
  std::istringstream stream(run.tracker);
  std::vector<std::string> names;
  for (std::string name; stream >> name;) {
    if (std::ranges::find(names, name) != names.end()) {
      throw ConfigError("tracker " + name + " is given twice; name each once");
    }
    names.push_back(name);
  }
  return names;
}

std::vector<ConfigSection> all_sections() {
  std::vector<ConfigSection> sections{ConfigSection::of<RunConfig>("run"),
                                      ConfigSection::of<FramesConfig>("frames"),
                                      ConfigSection::of<PointsConfig>("points")};
  for (const TrackerEntry& tracker : all_trackers()) sections.push_back(tracker.config());
  for (const SceneEntry& scene : all_scenes()) sections.push_back(scene.config());
  for (const RadarSceneEntry& scene : all_radar_scenes()) sections.push_back(scene.config());
  return sections;
}

ConfigSection section_named(std::span<const ConfigSection> sections, const std::string& name) {
  const auto found = std::ranges::find(sections, name, &ConfigSection::name);
  if (found == sections.end()) throw std::logic_error("no section " + name);
  return *found;
}

std::vector<ConfigSection> used_sections(std::span<const ConfigSection> all,
                                         std::span<const std::string> trackers,
                                         std::span<const std::string> more) {
  std::vector<std::string> names{"run", "frames"};
  const auto feeds_on_points = [](const std::string& tracker) {
    return find_tracker(tracker).feed != Feed::frames;
  };
  if (std::ranges::any_of(trackers, feeds_on_points)) names.emplace_back("points");
  for (const auto& tracker : trackers) {
    names.push_back("trackers." + std::string(find_tracker(tracker).name));
  }
  names.insert(names.end(), more.begin(), more.end());
  std::vector<ConfigSection> used;
  used.reserve(names.size());
  for (const auto& name : names) used.push_back(section_named(all, name));
  return used;
}

std::vector<ConfigSection> sections_with(std::string_view key, std::span<const ConfigSection> all) {
  const RunConfig run = section_named(all, "run").as<RunConfig>();
  std::vector<ConfigSection> read = used_sections(all, trackers_of(run));
  if (has_full_key(all, key) && !has_full_key(read, key)) {
    throw ConfigError(std::string(key) + " has no effect: a run with tracker " +
                      in_quotes(run.tracker) + " does not read it; leave it out");
  }
  return read;
}

void apply_settings(const Settings& settings, std::span<ConfigSection> all) {
  for (const Setting& setting : settings) {
    if (names_trackers(setting)) apply_value("run.tracker", setting.value, all);
  }
  for (const Setting& setting : settings) {
    if (setting.key == "profile") apply_profile(profile_of(setting), all);
  }
  for (const Setting& setting : settings) {
    if (names_trackers(setting) || setting.key == "profile") continue;
    std::vector<ConfigSection> read = sections_with(setting.key, all);
    apply_value(setting.key, setting.value, read);
  }
}

void add_trackers(Scheduler& scheduler, std::span<const ConfigSection> sections,
                  const Device& device) {
  const RunConfig run = section_named(sections, "run").as<RunConfig>();
  for (const std::string& name : trackers_of(run)) {
    const TrackerEntry& entry = find_tracker(name);
    const ConfigSection section = section_named(sections, "trackers." + std::string(entry.name));
    scheduler.add(entry.make(section, device, static_cast<std::uint64_t>(run.seed)), name);
  }
}

/// The settings that results of pushed frames depend on: not where and by how many threads they are
/// made.
std::string settings_of_results(std::span<const ConfigSection> sections, const RunConfig& run) {
  std::string text;
  for (const ConfigSection& section : used_sections(sections, trackers_of(run))) {
    text += '[' + section.name() + "]\n";
    for (const ConfigField& field : section.fields()) {
      const bool of_run = section.name() == "run";
      if (of_run && (field.key == "device" || field.key == "threads")) continue;
      text += field.key + " = " + to_toml(field) + '\n';
    }
  }
  return text;
}

namespace {

Device device_of(const RunConfig& run) {
  try {
    return Device::named(run.device, run.threads);
  } catch (const std::invalid_argument& e) {
    throw ConfigError(std::string("run.device: ") + e.what());
  }
}

}  // namespace

Scheduler pushed_frames_scheduler(std::span<const ConfigSection> sections) {
  const RunConfig run = section_named(sections, "run").as<RunConfig>();
  refuse_what_reads_files(run);
  if (trackers_of(run).empty()) {
    throw ConfigError("no tracker is named; name one, for example mm-phd");
  }
  const Device device = device_of(run);
  const FramesConfig frames = section_named(sections, "frames").as<FramesConfig>();
  Scheduler scheduler(device, FramePreparer(frames, device),
                      section_named(sections, "points").as<PointsConfig>());
  scheduler.prime(frames.background_prime);
  scheduler.keep(run.keep);
  add_trackers(scheduler, sections, device);
  scheduler.set_settings(settings_of_results(sections, run));
  return scheduler;
}

Scheduler scheduler_of(std::string_view trackers, const Settings& settings) {
  std::vector<ConfigSection> sections = all_sections();
  apply_value("run.tracker", std::string(trackers), sections);
  if (std::ranges::any_of(settings, names_trackers)) {
    throw ConfigError("trackers are named by the first argument; leave the setting tracker out");
  }
  apply_settings(settings, sections);
  return pushed_frames_scheduler(sections);
}

Scheduler::Scheduler(std::string_view trackers, const Settings& settings)
    : Scheduler(scheduler_of(trackers, settings)) {}

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

}  // namespace glint
