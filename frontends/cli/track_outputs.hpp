// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "glint/engine/scheduler.hpp"
#include "glint/frontends/cli/frame_job.hpp"
#include "glint/frontends/files/track_file.hpp"
#include "glint/frontends/video/overlay.hpp"

namespace glint::cli {

struct OutputOptions {
  std::vector<std::string> tracks;      ///< files
  std::string overlay, picture;         ///< files; empty = none
  std::string overlay_codec = "mpeg4";  ///< or "h264"
  TrackFileOptions file;
};

/// All that a run of trackers writes.
class TrackOutputs : public Sink {
 public:
  /// Opens every file, so that one that cannot be written is found out before the work starts:
  /// throws UsageError. With several trackers, tracks.csv becomes tracks.<tracker>.csv for each.
  TrackOutputs(const OutputOptions& options, const FrameJob& job, double frame_rate,
               const Scheduler& scheduler);
  void take(const ScanResult& result) override;
  /// Closes the files with what was tracked so far; also after a failed run. One that cannot be
  /// closed keeps no other from it: what the first one threw comes out at the end.
  void finish();
  std::vector<std::string> paths() const;

 private:
  struct Track {
    std::size_t tracker;
    TrackFile file;
  };
  const Scheduler& scheduler_;
  std::int64_t keep_;  // frames; 0 = all
  std::vector<Track> tracks_;
  std::vector<std::unique_ptr<ClosingSink>> pictures_;
};

/// What was estimated on the way, by the preparer and by tracker `i`.
std::vector<std::string> notes(const Scheduler& scheduler, std::size_t i);

}  // namespace glint::cli
