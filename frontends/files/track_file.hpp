// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "glint/engine/tracks.hpp"

namespace glint {

/// What a track file says about its run, so that the run can be repeated from it.
struct RunRecord {
  std::string tracker;  ///< its name
  std::string config;   ///< whole configuration as TOML, seed included
};

/// How tracks are written; each call returns whole lines.
class TrackFormat {
 public:
  virtual ~TrackFormat() = default;
  /// Comes first; `modes` name the mode probabilities of the points.
  virtual std::string header(const RunRecord& run, const std::vector<std::string>& modes) = 0;
  virtual std::string point(const TrackPoint& point) const = 0;
  /// `notes` say what was estimated.
  virtual std::string trailer(const std::vector<std::string>& notes) const = 0;
};

/// By the end of the name: .csv, .jsonl or .mot.txt (.txt). Throws UsageError for others.
std::unique_ptr<TrackFormat> track_format(const std::string& path);

/// Tracks on their way into a file: every frame is flushed as it comes, so that a run that breaks
/// off loses nothing.
class TrackFile {
 public:
  /// Creates the file. With `revised`, close() replaces what was written on the way by the revised
  /// record. Throws UsageError if the file cannot be written.
  TrackFile(std::string path, RunRecord run, bool revised);
  /// `modes` must be the same in every call. Throws std::runtime_error if the disk is full.
  void write(std::span<const TrackPoint> points, const std::vector<std::string>& modes);
  /// Adds what was reported late and what was estimated.
  void close(const TrackLog& log, const std::vector<std::string>& notes);

 private:
  void write_header(const std::vector<std::string>& modes);
  void write_late(const TrackLog& log);
  void write_revised(const TrackLog& log);

  std::string path_;
  RunRecord run_;
  bool revised_;
  std::unique_ptr<TrackFormat> format_;
  std::ofstream file_;
  bool has_header_ = false;
  std::vector<std::pair<std::int64_t, std::int64_t>> written_;  // frame, track; sorted
};

}  // namespace glint
