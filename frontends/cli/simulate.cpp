// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "glint/engine/scenario/scenario.hpp"
#include "glint/frontends/cli/commands.hpp"
#include "glint/frontends/cli/points_file.hpp"
#include "glint/frontends/files/npy.hpp"
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

/// A folder that already holds other frames would be read as one sequence with the new ones.
void make_folder(const std::string& folder, const std::string& format, std::int64_t frames) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder)) {
    throw UsageError(folder + ": cannot be made a folder; check its parent and permissions");
  }
  const bool tiff = format != "npy";
  if ((tiff && (fs::exists(frame_path(folder, frames)) || fs::exists(folder + "/frames.npy"))) ||
      (!tiff && fs::exists(frame_path(folder, 0)))) {
    throw UsageError(folder + ": holds frames of another simulation; give an empty folder");
  }
}

void simulate(SimulateOptions options) {
  if (options.format.empty()) options.format = default_format();
  const std::string section = "scenes." + std::string(find_scene(options.scene).name);
  options.frames.inputs = {"scene:" + options.scene};
  options.frames.sets.insert(options.frames.sets.begin(), "points.threshold=4");
  const FrameJob job = settle(options.frames, {"points"});
  const auto source = open_frames(job);
  make_folder(options.out, options.format, source->frame_count().value_or(0));
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

std::string scene_names() {
  std::string names;
  for (const SceneEntry& s : all_scenes()) {
    names += (names.empty() ? "" : ", ") + std::string(s.name);
  }
  return names;
}

}  // namespace

void add_simulate(Command& program) {
  auto options = std::make_shared<SimulateOptions>();
  Command command = program.subcommand("simulate", "Write a scene's frames, truth and points");
  command.option("SCENE", options->scene, scene_names()).required();
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
      "  glint evaluate --truth clip/truth.csv --tracks tracks.csv");
  command.callback([options] { simulate(*options); });
}

}  // namespace glint::cli
