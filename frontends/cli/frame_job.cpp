// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/cli/frame_job.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "glint/engine/profiles.hpp"
#include "glint/engine/scenario/scenario.hpp"
#include "glint/engine/settings.hpp"
#include "glint/engine/trackers/registry.hpp"
#include "glint/frontends/cli/config_file.hpp"
#include "glint/frontends/files/cued_source.hpp"
#include "glint/frontends/files/noisy_source.hpp"
#include "glint/frontends/files/open_source.hpp"
#include "glint/frontends/files/points_source.hpp"
#include "glint/kernels/auto_device.hpp"
#include "glint/kernels/prepare_frame/prepare_frame.hpp"

namespace glint::cli {
namespace {

/// A setting that decides which sections there are must come before those that stand in them.
bool sets_tracker(const std::string& assignment) {
  const std::string key = assignment.substr(0, assignment.find('='));
  return key == "run.tracker" || key == "tracker";
}

/// Sections of the scenes among the inputs, then `more`.
std::vector<std::string> further_sections(const std::vector<std::string>& inputs,
                                          const std::vector<std::string>& more) {
  std::vector<std::string> names;
  for (const auto& input : inputs) {
    if (const auto scene = scene_name(input)) {
      names.push_back("scenes." + std::string(find_scene(*scene).name));
    }
  }
  names.insert(names.end(), more.begin(), more.end());
  return names;
}

/// An option that is short for --set run.<key>=...
void add_run_option(Command& command, FrameOptions& options, const char* option, const char* key,
                    const char* help) {
  command.option(
      option, [&options, key](const std::string& v) { options.run.emplace_back(key, v); }, help);
}

AutoChoice make_device(const RunConfig& run) {
  try {
    if (run.device != "auto") return {Device::named(run.device, run.threads), ""};
    AutoChoice choice = choose_device(run.threads);
    if (choice.failed) warn("device auto: " + choice.why);
    return choice;
  } catch (const std::invalid_argument& e) {
    throw UsageError(e.what());
  }
}

Image<std::uint8_t> read_mask(const std::string& path, const Device& device) {
  SourceOptions options;
  options.warn = warn;
  const auto frame = open_source(std::span(&path, 1), options)->next();
  if (!frame) throw UsageError(path + ": holds no image; give one of the frames' size");
  Image<float> grey(frame->pixels.width, frame->pixels.height);
  device.run<ToGrey>({.raw = frame->pixels, .grey = grey.view()});
  Image<std::uint8_t> mask(grey.width(), grey.height());
  for (int y = 0; y < grey.height(); ++y) {
    for (int x = 0; x < grey.width(); ++x) mask.view()(x, y) = grey.view()(x, y) != 0 ? 1 : 0;
  }
  return mask;
}

void refuse_what_needs_frames(const FrameJob& job) {
  const std::string& input = job.inputs.front();
  for (const std::string& tracker : job.trackers) {
    if (find_tracker(tracker).feed == Feed::frames) {
      throw UsageError(
          fmt::format("{}: holds points, and {} needs frames; give frames or a tracker of "
                      "points, such as imm-pda-ai",
                      input, tracker));
    }
  }
  if (job.run().add_noise > 0) {
    throw UsageError(input + ": holds points, and noise is for frames; leave --add-noise out");
  }
  if (!job.run().points.empty()) {
    throw UsageError(input + ": holds points already; leave --points out, or give it with frames");
  }
}

/// The frames (or points) themselves, with noise added if so configured.
std::unique_ptr<Source> open_input(const FrameJob& job, const Warn& on_warning) {
  const RunConfig& run = job.run();
  const auto seed = static_cast<std::uint64_t>(run.seed);
  SourceOptions options;
  options.seed = seed;
  options.warn = on_warning;
  if (run.fps > 0) options.frame_rate = run.fps;
  if (!run.format.empty() || !run.size.empty()) options.raw = raw_format(run.format, run.size);
  ConfigSection scene;
  if (const auto name = scene_name(job.inputs.front())) {
    scene = section_named(job.sections, "scenes." + std::string(*name));
    options.scene = &scene;
  }
  if (holds_points(job)) refuse_what_needs_frames(job);
  auto source = open_source(job.inputs, options);
  if (run.add_noise == 0) return source;
  return std::make_unique<NoisySource>(std::move(source), run.add_noise, seed, job.device);
}

int frames_ahead(const FrameJob& job) {
  return job.config<FramesConfig>("frames").background_prime;
}

/// The first frame whose background is known, as far as trackers of frames need it.
std::int64_t background_from(const FrameJob& job) {
  const auto& frames = job.config<FramesConfig>("frames");
  const bool learns = frames.background == BackgroundKind::temporal ||
                      frames.background == BackgroundKind::registered;
  const bool needed = std::ranges::any_of(job.trackers, [](const std::string& tracker) {
    return find_tracker(tracker).feed == Feed::frames;
  });
  constexpr std::int64_t kSome = 5;  // a median of fewer frames holds the targets
  return learns && needed && frames.background_prime == 0 ? kSome : 0;
}

/// Standard input and pipes by name.
bool is_read_once(const FrameJob& job) {
  std::error_code unknown;
  const std::filesystem::file_status status = std::filesystem::status(job.inputs.front(), unknown);
  return job.inputs.front() == "-" || std::filesystem::is_fifo(status) ||
         std::filesystem::is_character_file(status) || std::filesystem::is_socket(status);
}

FramePreparer make_preparer(const FrameJob& job) {
  FramePreparer preparer(job.config<FramesConfig>("frames"), job.device);
  const std::string& mask = job.run().mask;
  if (!mask.empty()) preparer.set_mask(read_mask(mask, job.device));
  const int ahead = frames_ahead(job);
  if (ahead == 0 || is_read_once(job)) return preparer;
  // What there is to warn of, the run itself says.
  prime_background(preparer, *open_input(job, [](const std::string&) {}), ahead);
  return preparer;
}

}  // namespace

bool holds_points(const FrameJob& job) {
  const std::string& input = job.inputs.front();
  return input.ends_with(".csv") || input.ends_with(".jsonl");
}

void add_run_options(Command& command, FrameOptions& options) {
  command.option("--profile", options.profile, profile_help());
  command.option("--config", options.config,
                 "TOML file, or tracks in any format: the settings of the run that wrote them");
  command.option("--set", options.sets, "key=value, e.g. frames.polarity=dark; repeatable")
      .one_value();
  add_run_option(command, options, "--device", "device", "auto, serial, tbb, egl or egl:N [auto]");
  add_run_option(command, options, "--threads", "threads", "0 = all of the machine's [0]");
  add_run_option(command, options, "--seed", "seed", "of all random numbers [1]");
  command.flag("--quiet", options.quiet, "no progress line, no summary");
}

void add_frame_options(Command& command, FrameOptions& options) {
  command
      .option("INPUT", options.inputs,
              "video, images (folder, pattern like f_%04d.png, list, multi-page TIFF), FITS "
              "files or cubes, .npy cube, points (.csv, .jsonl), - (raw frames from standard "
              "input), or scene:NAME")
      .required();
  add_run_options(command, options);
  add_run_option(command, options, "--fps", "fps",
                 "frame rate, instead of the input's own (images: 1)");
  add_run_option(command, options, "--format", "format",
                 "of frames without a header, from a file, a pipe or - (standard input): gray8, "
                 "gray16le or grayf32le");
  add_run_option(command, options, "--size", "size", "of frames without a header, e.g. 640x512");
  add_run_option(command, options, "--add-noise", "add_noise",
                 "sigma of Gaussian noise to add first [grey levels]");
  add_run_option(command, options, "--mask", "mask",
                 "image of the frames' size; pixels that are not 0 are ignored");
}

FrameJob settle(const FrameOptions& options, const std::vector<std::string>& more) {
  std::vector<ConfigSection> all = all_sections();
  if (!options.profile.empty()) apply_profile(options.profile, all);
  if (!options.config.empty()) read_config(options.config, all);
  for (const auto& [key, text] : options.run) {
    apply_set(std::string("run.").append(key).append("=").append(text), all);
  }
  for (const auto& set : options.sets) {
    if (sets_tracker(set)) apply_set(set, all);
  }
  const ConfigSection run = section_named(all, "run");
  std::vector<std::string> trackers = trackers_of(run.as<RunConfig>());
  auto used = used_sections(all, trackers, further_sections(options.inputs, more));
  for (const auto& set : options.sets) apply_set(set, used);
  const AutoChoice choice = make_device(run.as<RunConfig>());
  // Results depend on the kind of device, so tracks say which one it was.
  const bool chosen = !choice.why.empty();
  if (chosen && choice.device.kind() == DeviceKind::egl) apply_set("run.device=egl", used);
  const std::string note =
      chosen ? std::string(name(choice.device.kind())) + ": " + choice.why : std::string();
  return {options.inputs, std::move(trackers), std::move(used), choice.device, options.quiet, note};
}

std::unique_ptr<Source> open_frames(const FrameJob& job) {
  auto frames = open_input(job, warn);
  const std::string& points = job.run().points;
  if (!points.empty()) frames = with_points(std::move(frames), points, warn);
  const std::string& cues = job.run().start_at;
  return cues.empty() ? std::move(frames)
                      : with_cues(std::move(frames), cues, warn, background_from(job));
}

Scheduler make_scheduler(const FrameJob& job) {
  const auto points = std::ranges::find(job.sections, "points", &ConfigSection::name);
  Scheduler scheduler(job.device, make_preparer(job),
                      points == job.sections.end() ? PointsConfig{} : points->as<PointsConfig>());
  if (is_read_once(job)) scheduler.prime(frames_ahead(job));
  return scheduler;
}

}  // namespace glint::cli
