// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "glint/engine/tracks/track_log.hpp"

namespace glint {

/// What a track file says about its run, so that the run can be repeated from it.
struct RunRecord {
  std::string tracker;  ///< its name
  std::string config;   ///< whole configuration as TOML, seed included
};

struct TrackFileOptions {
  bool revised = false;     ///< the revised record in place of what was reported at the time
  bool covariance = false;  ///< in CSV the velocity's too: kVelocityCovarianceNames after var_y
};

/// How tracks are written; each call returns whole lines, but for header().
class TrackFormat {
 public:
  virtual ~TrackFormat() = default;
  /// Comes first; `estimated` says what was estimated, null as long as the run lasts.
  virtual std::string header(const RunRecord& run,
                             const std::vector<std::string>* estimated) const = 0;
  /// `bytes` (3 or more) that mean nothing and end the header.
  virtual std::string padding(std::size_t bytes) const = 0;
  /// Comes next; `modes` name the mode probabilities of the points.
  virtual std::string columns(const std::vector<std::string>& modes) = 0;
  virtual std::string point(const TrackPoint& point) const = 0;
  /// What was estimated, where the header had no room for it.
  virtual std::string trailer(const std::vector<std::string>& estimated) const = 0;
  /// The format holds nothing but points: the header stands in a file of its own, path + ".toml".
  virtual bool bare() const { return false; }
};

/// By the end of the name: .csv, .jsonl or .mot.txt (.txt); JSON Lines for standard output, "-".
/// `covariance` is that of TrackFileOptions. Throws UsageError for others.
std::unique_ptr<TrackFormat> track_format(const std::string& path, bool covariance);

/// Tracks on their way into a file: every frame is flushed as it comes, so that a run that breaks
/// off loses nothing. Room is left in the header for what is estimated on the way, which is known
/// at the end; in a pipe, or if it does not fit, that comes last.
class TrackFile {
 public:
  /// Creates the file. With `options.revised`, close() replaces what was written on the way by the
  /// revised record; a pipe gets only that. Throws UsageError if the file cannot be written.
  TrackFile(std::string path, RunRecord run, const TrackFileOptions& options = {});
  /// `modes` must be the same in every call. Throws std::runtime_error if the disk is full.
  void write(std::span<const TrackPoint> points, const std::vector<std::string>& modes);
  /// No more is reported of the frames before `frame`: they need not be remembered.
  void forget(std::int64_t frame);
  /// Adds what was reported late and what was estimated. Throws as write() does.
  void close(const TrackLog& log, const std::vector<std::string>& estimated);
  /// All files written.
  std::vector<std::string> paths() const;

 private:
  void start(const std::vector<std::string>& modes);
  void write_late(const TrackLog& log);
  void write_revised(const TrackLog& log, const std::vector<std::string>& estimated);
  void write_estimated(const std::vector<std::string>& estimated);
  void write_sidecar(const std::vector<std::string>* estimated) const;

  std::string path_;
  RunRecord run_;
  bool revised_;
  std::unique_ptr<TrackFormat> format_;
  std::ofstream file_;
  bool seekable_, started_ = false;
  std::size_t room_ = 0;  // bytes of the header and its padding
  std::vector<std::pair<std::int64_t, std::int64_t>> written_;  // frame, track; sorted
};

/// The header of a format that is bare(): a TOML file with comments.
std::string sidecar_text(const RunRecord& run, const std::vector<std::string>* estimated);
/// Where it stands.
std::string sidecar_path(const std::string& path);

}  // namespace glint
