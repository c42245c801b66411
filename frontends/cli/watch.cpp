// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <unistd.h>

#include <chrono>
#include <csignal>

#include "glint/frontends/cli/frame_job.hpp"

namespace glint::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void on_signal(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);  // the next one ends the program
}

}  // namespace

void warn(const std::string& message) { fmt::print(stderr, "glint: warning: {}\n", message); }

Interrupt::Interrupt() {
  interrupted = 0;
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

Interrupt::~Interrupt() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

void Interrupt::take(const ScanResult&) {
  if (interrupted) stop_.request_stop();
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Progress::Progress(std::optional<std::int64_t> frames, bool quiet)
    : frames_(frames), shown_(!quiet && isatty(STDERR_FILENO)), start_(now()) {}

Progress::~Progress() {
  constexpr const char* kClearLine = "\r\033[K";
  if (shown_) fmt::print(stderr, kClearLine);
}

void Progress::take(const ScanResult& result) {
  constexpr double kInterval = 0.1;  // [s]
  const double time = now();
  if (!shown_ || time < next_) return;
  next_ = time + kInterval;
  const std::int64_t done = result.scan.frame + 1;
  std::size_t live = 0;
  for (const auto& points : result.reported) {
    for (const TrackPoint& p : points) live += p.status == TrackStatus::confirmed;
  }
  fmt::print(stderr, "\rframe {}{}  {:.0f} frames/s  {} live tracks\033[K", done,
             frames_ ? "/" + std::to_string(*frames_) : "",
             static_cast<double>(done) / (time - start_), live);
  std::fflush(stderr);
}

}  // namespace glint::cli
