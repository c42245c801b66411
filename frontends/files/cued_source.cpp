// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/cued_source.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "glint/engine/cue.hpp"
#include "glint/frontends/files/csv.hpp"

namespace glint {
namespace {

/// A row of the file.
struct FileCue {
  Cue cue;
  std::int64_t line;
  std::int64_t frame;  ///< -1: `time` alone says when
  double time;         ///< [s]
};

FileCue cue_of(const CsvRow& row, const std::string& path) {
  FileCue cue{{row.number(0), row.number(1), row.number(4), row.number(5), row.number(6)},
              row.line(),
              -1,
              row.number(3)};
  if (!row.text(2).empty()) {
    cue.frame = row.integer(2);
    if (cue.frame < 0) row.refuse(2, "at least 0");
  } else if (!std::isfinite(cue.time)) {
    throw std::runtime_error(
        fmt::format("{}:{}: a cue needs its frame, or its time in seconds", path, row.line()));
  }
  try {
    checked(cue.cue);
  } catch (const std::invalid_argument& e) {
    throw std::runtime_error(fmt::format("{}:{}: {}", path, row.line(), e.what()));
  }
  return cue;
}

std::vector<FileCue> read_cues(const std::string& path) {
  static constexpr std::array<std::string_view, 2> kRequired{"x", "y"};
  static constexpr std::array<std::string_view, 6> kOptional{"frame", "time",  "vx",
                                                             "vy",    "sigma", "track_id"};
  std::vector<FileCue> cues;
  std::set<std::string, std::less<>> tracks;
  read_csv(path, kRequired, kOptional, [&](const CsvRow& row) {
    const std::string_view track = row.text(7);
    if (!track.empty() && !tracks.emplace(track).second) return;  // its first row has been
    cues.push_back(cue_of(row, path));
  });
  return cues;
}

class CuedSource : public Source {
 public:
  CuedSource(std::unique_ptr<Source> frames, std::string path, Warn warn, std::int64_t learned_from)
      : frames_(std::move(frames)),
        cues_(read_cues(path)),
        path_(std::move(path)),
        warn_(std::move(warn)),
        learned_from_(learned_from) {}

  std::optional<SourceFrame> next() override {
    auto frame = frames_->next();
    if (!frame) {
      warn_of_rest();
      return frame;
    }
    number_ += frame->skipped;
    const auto first = std::stable_partition(
        cues_.begin(), cues_.end(), [&](const FileCue& cue) { return !belongs(cue, frame->time); });
    for (auto cue = first; cue != cues_.end(); ++cue) give(*cue, *frame);
    cues_.erase(first, cues_.end());
    ++number_;
    return frame;
  }
  std::optional<std::int64_t> frame_count() const override { return frames_->frame_count(); }
  double frame_rate() const override { return frames_->frame_rate(); }

 private:
  bool belongs(const FileCue& cue, double time) const {
    if (cue.frame >= 0) return cue.frame == number_;
    constexpr double kRounding = 1e-6;
    return cue.time <= time + (0.5 + kRounding) / frames_->frame_rate();
  }

  void give(FileCue& cue, SourceFrame& frame) const {
    if (cue.frame < 0) move_on(std::span(&cue.cue, 1), frame.time - cue.time);
    const auto& [data, width, height, channels, pitch] = frame.pixels;
    const bool outside = cue.cue.x < -0.5 || cue.cue.x >= width - 0.5 || cue.cue.y < -0.5 ||
                         cue.cue.y >= height - 0.5;
    if (width > 0 && outside) {
      warn_(
          fmt::format("{}:{}: the cue at ({:.6g}, {:.6g}) lies outside the frame of {}x{} and "
                      "starts no track there",
                      path_, cue.line, cue.cue.x, cue.cue.y, width, height));
    }
    if (number_ < learned_from_) {
      warn_(
          fmt::format("{}:{}: the cue in frame {} comes before the background is known, and may be "
                      "lost; --set frames.background_prime=100 learns it from 100 frames first",
                      path_, cue.line, number_));
    }
    frame.cues.push_back(cue.cue);
  }

  void warn_of_rest() {
    const auto rest = std::exchange(cues_, {}).size();
    if (rest == 0) return;
    warn_(fmt::format("{}: {} cues belong to no frame (there were {}) and started no track", path_,
                      rest, number_));
  }

  std::unique_ptr<Source> frames_;
  std::vector<FileCue> cues_;  // those that no frame has had yet
  std::string path_;
  Warn warn_;
  std::int64_t learned_from_;
  std::int64_t number_ = 0;  // of the next frame
};

}  // namespace

std::unique_ptr<Source> with_cues(std::unique_ptr<Source> frames, const std::string& path,
                                  const Warn& warn, std::int64_t learned_from) {
  return std::make_unique<CuedSource>(std::move(frames), path, warn, learned_from);
}

}  // namespace glint
