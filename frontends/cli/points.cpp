// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <memory>
#include <utility>

#include "glint/frontends/cli/commands.hpp"
#include "glint/frontends/cli/points_file.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint::cli {
namespace {

struct PointsOptions {
  FrameOptions frames;
  std::string out;
};

void find_all_points(const PointsOptions& options) {
  const FrameJob job = settle(options.frames, {"points"});
  if (!job.run().points.empty()) {
    throw UsageError("glint points finds the points itself; leave run.points out");
  }
  const auto source = open_frames(job);
  PointsFile points(options.out, job);
  const std::int64_t frames = run_sinks(job, *source, {&points});
  if (job.quiet) return;
  fmt::print("{} frames, {} points, written to {}\n", frames, points.points(), options.out);
}

}  // namespace

void add_points(Command& program) {
  auto options = std::make_shared<PointsOptions>();
  Command command = program.subcommand("points",
                                       "Points of single frames: maxima of the matched filter (the "
                                       "baseline), wavelets, or 5x5 units");
  add_frame_options(command, options->frames);
  command.option("--out", options->out, "points.csv").required();
  const auto setting = [&](const char* option, const char* key, const char* help) {
    command.option(
        option,
        [options, key](const std::string& v) {
          options->frames.sets.push_back(std::string(key) + '=' + v);
        },
        help);
  };
  setting("--detector", "points.detector", "matched-filter, wavelet or unit-5x5");
  setting("--threshold", "points.threshold", "least value of the filter or the wavelets [sigma]");
  setting("--psf-sigma", "points.psf_sigma", "point spread of the matched filter [px]");
  command.footer(
      "Example: how well does the best threshold do beside a tracker?\n"
      "  glint points clip.mp4 --add-noise 53 --out points.csv\n"
      "  glint evaluate --truth truth.csv --tracks tracks.csv --baseline points.csv");
  command.callback([options] { find_all_points(*options); });
}

}  // namespace glint::cli
