// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "glint/engine/scenario/radar_scenes.hpp"
#include "glint/engine/scenario/scenario.hpp"
#include "glint/frontends/cli/commands.hpp"
#include "glint/frontends/cli/points_file.hpp"
#include "glint/frontends/files/npy.hpp"
#include "glint/frontends/files/radar_points.hpp"
#include "glint/frontends/files/tables.hpp"
#include "glint/frontends/modules/video.hpp"

namespace glint::cli {
namespace {

namespace fs = std::filesystem;

struct SimulateOptions {
  FrameOptions frames;
  std::string scene, out, format;
};

std::string frame_path(const std::string& folder, std::int64_t frame) {
  return fmt::format("{}/frame_{:04}.tif", folder, frame);
}

class TiffFrames : public Sink {
 public:
  TiffFrames(std::string folder, bool float32) : folder_(std::move(folder)), float32_(float32) {}
  void take(const ScanResult& result) override {
    video_.write_image(frame_path(folder_, result.scan.frame), result.scan.raw.view(),
                       float32_ ? ImageDepth::float32 : ImageDepth::bits16);
  }

 private:
  std::string folder_;
  bool float32_;
  const VideoFunctions& video_ = video();
};

class NpyFrames : public Sink {
 public:
  explicit NpyFrames(const std::string& folder) : writer_(folder + "/frames.npy") {}
  void take(const ScanResult& result) override { writer_.write(result.scan.raw.view()); }

 private:
  NpyWriter writer_;
};

std::string default_format() { return has_video() ? "tiff32" : "npy"; }

std::unique_ptr<Sink> frame_writer(const std::string& folder, const std::string& format) {
  if (format == "npy") return std::make_unique<NpyFrames>(folder);
  if (!has_video()) {
    throw UsageError("this glint was built without OpenCV and writes no TIFF; use --format npy");
  }
  return std::make_unique<TiffFrames>(folder, format == "tiff32");
}

void make_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder)) {
    throw UsageError(folder + ": cannot be made a folder; check its parent and permissions");
  }
}

/// Frames of another simulation would be read as one sequence with the new ones, or beside truth
/// that is not theirs. `next`: the first frame that will not be written over.
void refuse_other_frames(const std::string& folder, std::int64_t next, bool overwrites_npy) {
  if (fs::exists(frame_path(folder, next)) ||
      (!overwrites_npy && fs::exists(folder + "/frames.npy"))) {
    throw UsageError(folder + ": holds frames of another simulation; give an empty folder");
  }
}

void simulate_frames(SimulateOptions options) {
  if (options.format.empty()) options.format = default_format();
  const std::string section = "scenes." + std::string(find_scene(options.scene).name);
  options.frames.inputs = {"scene:" + options.scene};
  options.frames.sets.insert(options.frames.sets.begin(), "points.threshold=4");
  const FrameJob job = settle(options.frames, {"points"});
  const auto source = open_frames(job);
  make_folder(options.out);
  const bool npy = options.format == "npy";
  refuse_other_frames(options.out, npy ? 0 : source->frame_count().value_or(0), npy);
  const Scene scene = find_scene(options.scene).make(section_named(job.sections, section));
  const auto truth = truth_of(scene);
  write_truth(options.out + "/truth.csv", truth,
              comment_lines(bare_toml(job.sections), "truth of scene " + options.scene));
  PointsFile points(options.out + "/points.csv", job);
  const auto frames = frame_writer(options.out, options.format);
  const std::int64_t count = run_sinks(job, *source, {frames.get(), &points});
  if (job.quiet) return;
  fmt::print("{} frames of {}x{}, {} targets, {} points, written to {}\n", count, scene.width,
             scene.height, scene.targets.size(), points.points(), options.out);
}

void simulate_radar(const SimulateOptions& options, const RadarSceneEntry& entry) {
  if (!options.format.empty()) {
    throw UsageError("scene " + options.scene + " has no frames; leave --format out");
  }
  const std::string section = "scenes." + options.scene;
  const FrameJob job = settle(options.frames, {section});
  const std::array sections{section_named(job.sections, "run"),
                            section_named(job.sections, section)};
  const RadarScene scene = entry.make(sections.back());
  make_folder(options.out);
  refuse_other_frames(options.out, 0, false);
  const std::string config = bare_toml(sections);
  write_truth(options.out + "/truth.csv", truth_of(scene),
              comment_lines(config, "truth of scene " + options.scene));
  const std::int64_t points = write_radar_points(
      options.out + "/points.csv", scene, static_cast<std::uint64_t>(job.run().seed),
      comment_lines(config, "points of scene " + options.scene));
  if (job.quiet) return;
  fmt::print("{} scans, {} targets, {} points, written to {}\n", scene.scans, scene.targets.size(),
             points, options.out);
}

void simulate(const SimulateOptions& options) {
  const RadarSceneEntry* radar = find_radar_scene(options.scene);
  if (radar != nullptr) {
    simulate_radar(options, *radar);
  } else {
    simulate_frames(options);
  }
}

template <class Entries>
std::string names_of(const Entries& entries) {
  std::string names;
  for (const auto& entry : entries) names += (names.empty() ? "" : ", ") + std::string(entry.name);
  return names;
}

}  // namespace

void add_simulate(Command& program) {
  auto options = std::make_shared<SimulateOptions>();
  Command command = program.subcommand(
      "simulate", "Write a scene's frames, truth and points; of a radar's scene, truth and points");
  command
      .option("SCENE", options->scene,
              names_of(all_scenes()) + "; without frames: " + names_of(all_radar_scenes()))
      .required();
  command.option("--out", options->out, "folder, made if need be").required();
  command
      .option(
          "--format", options->format,
          "tiff32 (float), tiff16 (rounded, clipped to 0..65535) or npy [" + default_format() + "]")
      .one_of({"tiff32", "tiff16", "npy"});
  add_run_options(command, options->frames);
  command.footer(
      "Examples:\n"
      "  glint simulate ir-clip --out clip --seed 3\n"
      "  glint simulate phd-5.1 --out dim --set snr=8 --format npy\n"
      "  glint track clip --tracker smc-phd --out tracks.csv\n"
      "  glint evaluate --truth clip/truth.csv --tracks tracks.csv\n"
      "A radar's scene in m, s and rad; glint config radar-aircraft says what it can be told:\n"
      "  glint simulate radar-aircraft --set clutter=0.02 --out air\n"
      "  glint track air/points.csv --tracker imm-mscan-jpda --set measurement=range-azimuth \\\n"
      "    --set range_sd=20 --set azimuth_sd=0.007 --set motion=ncv+wpa+wpa --set noise=5 \\\n"
      "    --set noise_agile=7.5 --set noise_jump=40 --set speed_max=500 --out tracks.csv\n"
      "  glint evaluate --truth air/truth.csv --tracks tracks.csv --cutoff 300");
  command.callback([options] { simulate(*options); });
}

}  // namespace glint::cli
