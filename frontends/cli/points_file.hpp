// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <fstream>
#include <string>

#include "glint/engine/scheduler.hpp"
#include "glint/frontends/cli/frame_job.hpp"

namespace glint::cli {

/// Writes points.csv: the points of scans.
class PointsFile : public Sink {
 public:
  /// Throws UsageError if the file cannot be written.
  PointsFile(std::string path, const FrameJob& job);
  void take(const ScanResult& result) override;
  std::int64_t points() const { return count_; }

 private:
  std::string path_;
  std::ofstream file_;
  std::int64_t count_ = 0;
};

/// Runs the frames of `job` and their points, as [points] says, into sinks, without trackers, with
/// progress line and Ctrl-C. Returns the number of frames.
std::int64_t run_sinks(const FrameJob& job, Source& source, const std::vector<Sink*>& sinks);

}  // namespace glint::cli
