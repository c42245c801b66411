// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/track_file.hpp"

#include <algorithm>

#include "glint/frontends/files/tables.hpp"

namespace glint {

TrackFile::TrackFile(std::string path, RunRecord run, bool revised)
    : path_(std::move(path)),
      run_(std::move(run)),
      revised_(revised),
      format_(track_format(path_)),
      file_(open_output(path_)) {}

void TrackFile::write_header(const std::vector<std::string>& modes) {
  if (!has_header_) file_ << format_->header(run_, modes);
  has_header_ = true;
}

void TrackFile::write(std::span<const TrackPoint> points, const std::vector<std::string>& modes) {
  write_header(modes);
  for (const TrackPoint& point : points) {
    file_ << format_->point(point);
    written_.emplace_back(point.frame, point.track_id);
  }
  flush_output(file_, path_);
}

void TrackFile::write_late(const TrackLog& log) {
  for (const TrackPoint& point : log.online()) {
    const std::pair key{point.frame, point.track_id};
    if (!std::ranges::binary_search(written_, key)) file_ << format_->point(point);
  }
}

void TrackFile::write_revised(const TrackLog& log) {
  file_.close();
  file_ = open_output(path_);
  has_header_ = false;
  write_header(log.mode_names());
  for (const TrackPoint& point : log.revised()) file_ << format_->point(point);
}

void TrackFile::close(const TrackLog& log, const std::vector<std::string>& notes) {
  write_header(log.mode_names());
  if (revised_) {
    write_revised(log);
  } else {
    write_late(log);
  }
  file_ << format_->trailer(notes);
  flush_output(file_, path_);
}

}  // namespace glint
