// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "glint/engine/run_config.hpp"
#include "glint/engine/scheduler.hpp"
#include "glint/frontends/cli/command.hpp"

namespace glint::cli {

/// What commands that read frames are told; see add_frame_options().
struct FrameOptions {
  std::vector<std::string> inputs, sets;
  std::string profile, config;
  std::vector<std::pair<std::string, std::string>> run;  ///< key and text of [run] settings
  bool quiet = false;
};
/// Adds --profile, --config, --set, --device, --threads, --seed and --quiet. `options` must live as
/// long as the command.
void add_run_options(Command& command, FrameOptions& options);
/// Adds INPUT..., the run options, --fps, --format, --size, --add-noise and --mask.
void add_frame_options(Command& command, FrameOptions& options);

/// What a run of frames is made of, settled from file and options. Order: defaults, --profile,
/// --config, options, --set.
struct FrameJob {
  std::vector<std::string> inputs, trackers;
  std::vector<ConfigSection> sections;  ///< those that this run uses
  Device device;
  bool quiet;
  std::string auto_note = {};  ///< which device `auto` took, and why; else empty

  template <class C>
  const C& config(const std::string& section) const {
    return section_named(sections, section).as<C>();
  }
  const RunConfig& run() const { return config<RunConfig>("run"); }
};

/// Sections beyond [run], [frames], those of the trackers in [run], [points] if one feeds on them,
/// and that of a scene that is the input are used if `more` names them. Throws UsageError and
/// ConfigError.
FrameJob settle(const FrameOptions& options, const std::vector<std::string>& more = {});

/// Whether the input is a file of points, without frames.
bool holds_points(const FrameJob& job);
/// The input, with noise added and points beside it if so configured. Throws UsageError if it holds
/// points and something needs frames.
std::unique_ptr<Source> open_frames(const FrameJob& job);
/// Without trackers and sinks.
Scheduler make_scheduler(const FrameJob& job);

/// Writes "glint: warning: ..." to stderr.
void warn(const std::string& message);

/// While it lives, the first Ctrl-C (or SIGTERM) asks runs that take stop() to end; the second ends
/// the program. One at a time.
class Interrupt : public Sink {
 public:
  Interrupt();
  ~Interrupt() override;
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;
  std::stop_token stop() const { return stop_.get_token(); }
  bool happened() const { return stop_.stop_requested(); }
  void take(const ScanResult& result) override;  ///< looks whether it was asked for

 private:
  std::stop_source stop_;
};

/// Shows frame, frames/s and live tracks on one line of a terminal; nothing elsewhere.
class Progress : public Sink {
 public:
  Progress(std::optional<std::int64_t> frames, bool quiet);
  ~Progress() override;
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void take(const ScanResult& result) override;

 private:
  std::optional<std::int64_t> frames_;
  bool shown_;
  double start_, next_ = 0;  // [s]
};

/// Seconds on a steady clock.
double now();

}  // namespace glint::cli
