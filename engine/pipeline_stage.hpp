// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "glint/engine/scheduler.hpp"

namespace glint {

/// One frame on its way through the stages.
struct Token {
  std::int64_t frame = 0;
  std::optional<SourceFrame> source;
  Scan scan;
  std::vector<PointMeasurement> points;  // what scan.points shows
  std::vector<Cue> cues;
  std::vector<std::vector<TrackPoint>> reported;
  bool failed = false;       // not to be delivered: its own failure, or an earlier frame's
  std::exception_ptr error;  // its own
};

/// Sees the frames one after another, in order. Closes at the first failed one: whatever comes
/// behind it passes untouched.
class Stage {
 public:
  explicit Stage(std::string name) : name_(std::move(name)) {}

  template <class Work>
  void pass(Token& token, const Work& work) {
    closed_ = closed_ || token.failed;
    if (!closed_) token.error = attempt(work);
    token.failed = closed_;
  }
  /// Runs work() on the stage's clock; what it throws closes the stage and is returned.
  template <class Work>
  std::exception_ptr attempt(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    std::exception_ptr error;
    try {
      work();
    } catch (...) {
      error = std::current_exception();
      closed_ = threw_ = true;
    }
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return error;
  }
  bool threw() const { return threw_; }
  StageTime time() const { return {name_, seconds_}; }

 private:
  std::string name_;
  double seconds_ = 0;
  bool closed_ = false, threw_ = false;
};

}  // namespace glint
