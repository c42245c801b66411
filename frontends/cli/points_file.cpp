// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/cli/points_file.hpp"

#include <fmt/core.h>

#include <utility>

#include "glint/engine/number_text.hpp"
#include "glint/frontends/files/tables.hpp"

namespace glint::cli {

PointsFile::PointsFile(std::string path, const FrameJob& job)
    : path_(std::move(path)), file_(open_output(path_)) {
  file_ << comment_lines(bare_toml(job.sections), "points of single frames")
        << "frame,time,x,y,amplitude\n";
}

void PointsFile::take(const ScanResult& result) {
  const Scan& scan = result.scan;
  for (const PointMeasurement& p : scan.points) {
    std::string row = std::to_string(scan.frame) + ',';
    append_rounded(row, scan.time, 9, 6), row += ',';
    append_rounded(row, p.x, 7, 3), row += ',';
    append_rounded(row, p.y, 7, 3);
    file_ << row << fmt::format(",{:.6g}\n", p.amplitude);
    ++count_;
  }
  flush_output(file_, path_);
}

std::int64_t run_sinks(const FrameJob& job, Source& source, const std::vector<Sink*>& sinks) {
  Scheduler scheduler = make_scheduler(job);
  scheduler.find_points();
  Progress progress(source.frame_count(), job.quiet);
  Interrupt interrupt;
  for (Sink* sink : sinks) scheduler.add(*sink);
  scheduler.add(progress);
  scheduler.add(interrupt);
  const std::int64_t frames = scheduler.run(source, interrupt.stop());
  if (!interrupt.happened()) return frames;
  throw std::runtime_error(
      fmt::format("interrupted after {} frames; what was done so far is written", frames));
}

}  // namespace glint::cli
