// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <utility>

#include "glint/engine/trackers/registry.hpp"
#include "glint/frontends/cli/commands.hpp"
#include "glint/frontends/cli/frame_job.hpp"
#include "glint/frontends/cli/track_outputs.hpp"
#include "glint/frontends/files/tables.hpp"

namespace glint::cli {
namespace {

struct TrackOptions {
  FrameOptions frames;
  OutputOptions outputs;
  std::vector<std::string> trackers;
};

std::string tracker_names() {
  std::string names;
  for (const TrackerEntry& t : all_trackers()) {
    names += (names.empty() ? "" : ", ") + std::string(t.name);
  }
  return names;
}

/// How many tracks were ever confirmed, and how many never.
std::pair<int, int> count_tracks(const TrackLog& log) {
  std::map<std::int64_t, bool> confirmed;
  for (const TrackPoint& p : log.online()) {
    confirmed[p.track_id] |= p.status == TrackStatus::confirmed;
  }
  int yes = 0;
  for (const auto& [id, is] : confirmed) yes += is;
  return {yes, static_cast<int>(confirmed.size()) - yes};
}

std::string shares(const std::vector<StageTime>& stages) {
  double total = 0;
  for (const StageTime& s : stages) total += s.seconds;
  std::string text;
  for (const StageTime& s : stages) {
    text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", s.stage,
                        total > 0 ? 100 * s.seconds / total : 0);
  }
  return text;
}

void print_summary(const FrameJob& job, const Scheduler& scheduler, double seconds,
                   double frame_rate, const std::vector<std::string>& written) {
  // Where tracks go to standard output they alone do.
  const bool piped = std::ranges::find(written, kStandardOutput) != written.end();
  std::FILE* to = piped ? stderr : stdout;
  const std::int64_t frames = scheduler.frames();
  const double rate = seconds > 0 ? static_cast<double>(frames) / seconds : 0;
  fmt::print(to, "frames     {} in {:.2f} s: {:.0f} frames/s, {:.3g} x the source's {:.4g}\n",
             frames, seconds, rate, rate / frame_rate, frame_rate);
  fmt::print(to, "device     {}, seed {}\n", job.device.description(), job.run().seed);
  if (!job.auto_note.empty()) fmt::print(to, "auto       {}\n", job.auto_note);
  for (std::size_t i = 0; i < job.trackers.size(); ++i) {
    const auto [confirmed, tentative] = count_tracks(*scheduler.logs()[i]);
    fmt::print(to, "tracks     {}: {} confirmed, {} never more than tentative\n", job.trackers[i],
               confirmed, tentative);
    for (const auto& note : scheduler.tracker(i).notes()) fmt::print(to, "estimated  {}\n", note);
  }
  for (const auto& note : scheduler.preparer().notes()) fmt::print(to, "estimated  {}\n", note);
  fmt::print(to, "stages     {}\n", shares(scheduler.stage_times()));
  fmt::print(to, "written    {}\n",
             written.empty() ? "nothing; --out tracks.csv keeps the tracks"
                             : fmt::format("{}", fmt::join(written, ", ")));
}

/// The first error is the one to report.
void finish_after_failure(TrackOutputs& outputs) {
  try {
    outputs.finish();
  } catch (const std::exception& e) {
    warn(e.what());
  }
}

void refuse_sharing(const FrameJob& job, const OutputOptions& outputs) {
  const auto piped = std::ranges::count(outputs.tracks, kStandardOutput);
  if (piped > 1 || (piped == 1 && job.trackers.size() > 1)) {
    throw UsageError("--out -: one tracker's tracks go to standard output; give the others a file");
  }
}

void track(TrackOptions options) {
  if (!options.trackers.empty()) {
    options.frames.run.emplace_back("tracker", fmt::format("{}", fmt::join(options.trackers, " ")));
  }
  const FrameJob job = settle(options.frames);
  if (job.trackers.empty()) throw UsageError("give --tracker NAME; known are " + tracker_names());
  if (holds_points(job) && !(options.outputs.overlay.empty() && options.outputs.picture.empty())) {
    throw UsageError(job.inputs.front() +
                     ": holds points, no frames to draw on; leave --overlay and --picture out");
  }
  refuse_sharing(job, options.outputs);
  const auto source = open_frames(job);
  Scheduler scheduler = make_scheduler(job);
  add_trackers(scheduler, job.sections, job.device);
  scheduler.keep(job.run().keep);
  TrackOutputs outputs(options.outputs, job, source->frame_rate(), scheduler);
  Interrupt interrupt;
  scheduler.add(outputs);
  scheduler.add(interrupt);
  const double start = now();
  try {
    Progress progress(source->frame_count(), job.quiet);
    scheduler.add(progress);
    scheduler.run(*source, interrupt.stop());
  } catch (...) {
    finish_after_failure(outputs);
    throw;
  }
  outputs.finish();
  if (scheduler.frames() == 0 && !interrupt.happened()) {
    throw std::runtime_error(job.inputs.front() + ": holds no frames; give one that does");
  }
  if (!job.quiet) {
    print_summary(job, scheduler, now() - start, source->frame_rate(), outputs.paths());
  }
  if (interrupt.happened()) {
    throw std::runtime_error(fmt::format(
        "interrupted after {} frames; what was tracked so far is written", scheduler.frames()));
  }
}

}  // namespace

void add_track(Command& program) {
  auto options = std::make_shared<TrackOptions>();
  Command command = program.subcommand("track", "Follow targets through frames");
  add_frame_options(command, options->frames);
  command
      .option("--tracker", options->trackers, "which tracker (" + tracker_names() + "); repeatable")
      .one_value();
  command.option(
      "--points",
      [options](const std::string& v) { options->frames.run.emplace_back("points", v); },
      "points (.csv, .jsonl) that go with the frames, by frame or time, for trackers of points, "
      "instead of those found in the frames");
  command.option(
      "--start-at",
      [options](const std::string& v) { options->frames.run.emplace_back("start_at", v); },
      "targets that somebody has seen (.csv: frame or time, x, y and, if known, vx, vy [px/s], "
      "sigma [px]; of tracks the first row each): every tracker starts a track on each");
  command
      .option("--out", options->outputs.tracks,
              "tracks as .csv, .jsonl or .mot.txt (confirmed only, with the run's settings "
              "beside them in .mot.txt.toml), or - for JSON Lines on standard output as they "
              "come; repeatable")
      .one_value();
  command.option("--overlay", options->outputs.overlay,
                 "video of the frames with the tracks, .mp4, .avi or .mkv");
  command
      .option("--overlay-codec", options->outputs.overlay_codec,
              "of .mp4 and .mkv: mpeg4, or h264, which browsers play and takes ten times as long")
      .one_of({"mpeg4", "h264"})
      .with_default();
  command.option("--picture", options->outputs.picture, "one such frame beside the raw one, .png");
  command.flag("--revised", options->outputs.file.revised,
               "write tracks as revised later, not as reported at the time");
  command.flag("--covariance", options->outputs.file.covariance,
               "in .csv the velocity's covariance too, behind that of the position (var_x, cov_xy, "
               "var_y [px^2]): cov_x_vx, cov_x_vy, cov_y_vx, cov_y_vy [px^2/s], var_vx, cov_vx_vy, "
               "var_vy [px^2/s^2]; .jsonl always has it");
  command.footer(
      "Examples:\n"
      "  glint track clip.mp4 --tracker smc-phd --out tracks.csv --overlay overlay.mp4\n"
      "  glint track frames/f_%04d.png --fps 50 --tracker smc-phd --set frames.polarity=dark\n"
      "  glint track clip.mp4 --tracker smc-phd --add-noise 53 --seed 2 --out noisy.csv\n"
      "  glint track clip.mp4 --tracker mm-phd --profile L --out tracks.csv\n"
      "  glint track points.csv --tracker imm-pda-ai --out tracks.csv\n"
      "  glint track clip.mp4 --points radar.csv --tracker mm-phd --tracker imm-jpda --out t.csv\n"
      "  glint track clip.mp4 --tracker mm-phd --start-at targets.csv --out tracks.csv\n"
      "  camera | glint track - --format gray16le --size 640x512 --fps 100 --tracker mm-phd --out "
      "-\n"
      "  glint track clip.mp4 --config tracks.csv      repeats the run that wrote it\n"
      "All settings: glint config TRACKER");
  command.callback([options] { track(*options); });
}

}  // namespace glint::cli
