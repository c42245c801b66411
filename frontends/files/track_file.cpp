// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/track_file.hpp"

#include <algorithm>
#include <filesystem>

#include "glint/frontends/files/tables.hpp"

namespace glint {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRoom = 1024;  // for what is estimated [bytes]
constexpr std::size_t kLeastPadding = 3;

}  // namespace

TrackFile::TrackFile(std::string path, RunRecord run, const TrackFileOptions& options)
    : path_(std::move(path)),
      run_(std::move(run)),
      revised_(options.revised),
      format_(track_format(path_, options.covariance)),
      file_(open_output(path_)),
      seekable_(path_ != kStandardOutput && fs::is_regular_file(path_)) {
  if (format_->bare()) write_sidecar(nullptr);
}

void TrackFile::start(const std::vector<std::string>& modes) {
  if (std::exchange(started_, true)) return;
  if (!format_->bare()) {
    const std::string header = format_->header(run_, nullptr);
    room_ = header.size() + (seekable_ ? kRoom : kLeastPadding);
    file_ << header << format_->padding(room_ - header.size());
  }
  file_ << format_->columns(modes);
}

void TrackFile::write(std::span<const TrackPoint> points, const std::vector<std::string>& modes) {
  if (revised_ && !seekable_) return;
  start(modes);
  for (const TrackPoint& point : points) {
    file_ << format_->point(point);
    written_.emplace_back(point.frame, point.track_id);
  }
  flush_output(file_, path_);
}

void TrackFile::forget(std::int64_t frame) {
  const auto kept =
      std::ranges::lower_bound(written_, frame, {}, [](const auto& key) { return key.first; });
  // By half, so that on the whole each is moved once.
  if (2 * (kept - written_.begin()) < std::ssize(written_)) return;
  written_.erase(written_.begin(), kept);
}

void TrackFile::close(const TrackLog& log, const std::vector<std::string>& estimated) {
  if (revised_) {
    write_revised(log, estimated);
  } else {
    start(log.mode_names());
    write_late(log);
    if (!format_->bare()) write_estimated(estimated);
    flush_output(file_, path_);
  }
  if (format_->bare()) write_sidecar(&estimated);
}

void TrackFile::write_late(const TrackLog& log) {
  for (const TrackPoint& point : log.online()) {
    const std::pair key{point.frame, point.track_id};
    if (!std::ranges::binary_search(written_, key)) file_ << format_->point(point);
  }
}

void TrackFile::write_estimated(const std::vector<std::string>& estimated) {
  const std::string header = format_->header(run_, &estimated);
  if (!seekable_ || header.size() + kLeastPadding > room_) {
    file_ << format_->trailer(estimated);
    return;
  }
  file_.seekp(0);
  file_ << header << format_->padding(room_ - header.size());
}

/// Beside the file first, so that what was written on the way is there until all is.
void TrackFile::write_revised(const TrackLog& log, const std::vector<std::string>& estimated) {
  const std::string target = seekable_ ? fs::canonical(path_).string() : path_;
  const std::string path = seekable_ ? target + ".part" : path_;
  if (seekable_) file_ = open_output(path);
  if (!format_->bare()) {
    file_ << format_->header(run_, &estimated) << format_->padding(kLeastPadding);
  }
  file_ << format_->columns(log.mode_names());
  for (const TrackPoint& point : log.revised()) file_ << format_->point(point);
  flush_output(file_, path);
  if (seekable_) fs::rename(path, target);
}

void TrackFile::write_sidecar(const std::vector<std::string>* estimated) const {
  const std::string path = sidecar_path(path_);
  std::ofstream file = open_output(path);
  file << sidecar_text(run_, estimated);
  flush_output(file, path);
}

std::vector<std::string> TrackFile::paths() const {
  if (format_->bare()) return {path_, sidecar_path(path_)};
  return {path_};
}

}  // namespace glint
