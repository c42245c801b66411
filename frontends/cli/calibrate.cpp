// SPDX-License-Identifier: Apache-2.0
#include "glint/experiments/calibration.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "glint/engine/number_text.hpp"
#include "glint/frontends/cli/commands.hpp"
#include "glint/frontends/cli/frame_job.hpp"
#include "glint/frontends/cli/run_progress.hpp"

namespace glint::cli {
namespace {

struct Request {
  std::string tracker, size;
  FrameOptions run;
  CalibrationOptions options;
  bool json = false;
};

/// "256x128"
void read_size(const std::string& text, NoiseScene& noise) {
  const auto read = [](std::string_view part, int& value) {
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    return error == std::errc{} && end == part.data() + part.size() && value >= 1 && value <= 32768;
  };
  const std::string_view all = text;
  const std::size_t cross = std::min(all.find('x'), all.size() - 1);
  if (!read(all.substr(0, cross), noise.width) || !read(all.substr(cross + 1), noise.height)) {
    throw UsageError("--size must be like 256x128, of 1 to 32768 pixels each way, got " + text);
  }
}

std::string setting_text(const Threshold& threshold, const Calibration& found) {
  return fmt::format("trackers.{}.{}={}", threshold.tracker, threshold.key,
                     number_text(found.value));
}

std::string rate_text(const FalseTracks& f) {
  return fmt::format("{:.4g} +- {:.2g} ({} tracks)", f.rate, f.error, f.tracks);
}

void print_text(const Threshold& threshold, const Calibration& found,
                const CalibrationOptions& options) {
  const NoiseScene& noise = options.noise;
  fmt::print("{}, white noise, {} runs of {} frames of {}x{}, seed {}\n", threshold.tracker,
             options.runs, noise.frames, noise.width, noise.height, options.seed);
  fmt::print("{} = {}\n\n", threshold.key, number_text(found.value));
  fmt::print("false tracks per frame and megapixel\n");
  fmt::print("  wanted, at most   {:g}\n", options.false_tracks);
  fmt::print("  attained          {}\n", rate_text(found.attained));
  fmt::print("  on other seeds    {}\n\n", rate_text(found.checked));
  fmt::print("--set {}\n\n[trackers.{}]\n{} = {}\n", setting_text(threshold, found),
             threshold.tracker, threshold.key, number_text(found.value));
}

void print_json(const Threshold& threshold, const Calibration& found,
                const CalibrationOptions& options) {
  const auto rate = [](const FalseTracks& f) {
    return nlohmann::ordered_json{{"rate", f.rate}, {"error", f.error}, {"tracks", f.tracks}};
  };
  const NoiseScene& noise = options.noise;
  const nlohmann::ordered_json all{{"tracker", threshold.tracker},
                                   {"key", threshold.key},
                                   {"value", found.value},
                                   {"unit", "false tracks per frame and megapixel"},
                                   {"wanted", options.false_tracks},
                                   {"attained", rate(found.attained)},
                                   {"checked", rate(found.checked)},
                                   {"runs", options.runs},
                                   {"frames", noise.frames},
                                   {"width", noise.width},
                                   {"height", noise.height},
                                   {"seed", options.seed},
                                   {"set", setting_text(threshold, found)}};
  fmt::print("{}\n", all.dump());
}

/// A rate that is told from a handful of tracks is hardly known.
void warn_of_doubt(const Threshold& threshold, const Calibration& found,
                   const CalibrationOptions& options) {
  const double expected = options.false_tracks * found.megapixel_frames;
  if (expected < 10) {
    warn(
        fmt::format("at the wanted rate these runs hold {:.2g} false tracks: more --runs, --frames "
                    "or pixels tell the value better",
                    expected));
  }
  if (found.at_lax_end) {
    warn(fmt::format("{} = {} is the laxest value looked at, and keeps the rate; laxer ones may",
                     threshold.key, number_text(found.value)));
  }
}

void calibrate(Request request) {
  CalibrationOptions& options = request.options;
  read_size(request.size, options.noise);
  const Threshold& threshold = find_threshold(request.tracker);
  const std::string tracker(threshold.tracker);
  request.run.run.emplace_back("tracker", tracker);
  const FrameJob job = settle(request.run);
  const auto points = std::ranges::find(job.sections, "points", &ConfigSection::name);
  if (points != job.sections.end()) options.points = points->as<PointsConfig>();
  options.seed = static_cast<std::uint64_t>(job.run().seed);
  // What auto takes for one run is not for many at once.
  options.device = job.auto_note.empty() ? job.device.kind() : DeviceKind::tbb;
  if (options.device == DeviceKind::egl) {
    throw UsageError("calibrate runs many trials at once, on auto, serial or tbb, not on egl");
  }
  if (!job.quiet) options.progress = run_progress();
  ConfigSection section = section_named(job.sections, "trackers." + tracker);
  Workers workers(job.run().threads);
  const Calibration found = glint::calibrate(threshold, section, options, workers);
  if (request.json) {
    print_json(threshold, found, options);
  } else {
    print_text(threshold, found, options);
  }
  if (!job.quiet) warn_of_doubt(threshold, found, options);
}

std::string table() {
  std::string list;
  for (const Threshold& t : all_thresholds()) {
    list += fmt::format("  {:<18}{:<20}{:g} to {:g}\n", t.tracker, t.key, t.lax, t.strict);
  }
  return list;
}

}  // namespace

void add_calibrate(Command& program) {
  const auto request = std::make_shared<Request>();
  CalibrationOptions& options = request->options;
  request->size = fmt::format("{}x{}", options.noise.width, options.noise.height);
  Command command = program.subcommand(kCalibrate.name, kCalibrate.description);
  command.option("TRACKER", request->tracker, "name, see below").required();
  command
      .option("--false-tracks", options.false_tracks,
              "wanted, at most; confirmed tracks per frame and megapixel")
      .in_range(1e-9, 1e9)
      .with_default();
  command.option("--runs", options.runs, "sequences of noise, with seeds from --seed on")
      .in_range(1, 1000000)
      .with_default();
  command.option("--frames", options.noise.frames, "of a sequence")
      .in_range(1, 1000000)
      .with_default();
  command.option("--size", request->size, "of a frame [px]").with_default();
  add_run_options(command, request->run);
  command.flag("--json", request->json, "print JSON instead");
  command.footer("Thresholds, laxest to strictest value looked at:\n" + table() +
                 "Example:\n"
                 "  glint calibrate viterbi --false-tracks 0.1 --set speed_max=3");
  command.callback([request] { calibrate(*request); });
}

}  // namespace glint::cli
