// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/points_source.hpp"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "glint/frontends/files/point_scans.hpp"

namespace glint {
namespace {

void take(PointScan& scan, SourceFrame& frame) {
  frame.points = std::move(scan.points);
  frame.sensor_x = scan.sensor_x, frame.sensor_y = scan.sensor_y;
}

/// Delivers a scan for every frame from 0 on, empty where the file has none.
class PointsSource : public Source {
 public:
  PointsSource(std::vector<PointScan> scans, double frame_rate)
      : scans_(std::move(scans)), frame_rate_(frame_rate) {}

  std::optional<SourceFrame> next() override {
    if (at_ == scans_.size()) return std::nullopt;
    PointScan& scan = scans_[at_];
    SourceFrame result;
    if (frame_ < scan.frame) {
      result.time = time_of_gap(scan);
      result.points.emplace();
    } else {
      result.time = scan.time;
      take(scan, result);
      ++at_;
    }
    ++frame_;
    return result;
  }
  std::optional<std::int64_t> frame_count() const override {
    return scans_.empty() ? 0 : scans_.back().frame + 1;
  }
  double frame_rate() const override { return frame_rate_; }

 private:
  /// Evenly between the scans about it.
  double time_of_gap(const PointScan& after) const {
    const auto ahead = static_cast<double>(after.frame - frame_);
    if (at_ == 0) return after.time - ahead / frame_rate_;
    const PointScan& before = scans_[at_ - 1];
    const auto whole = static_cast<double>(after.frame - before.frame);
    return after.time - (after.time - before.time) * ahead / whole;
  }

  std::vector<PointScan> scans_;
  double frame_rate_;
  std::size_t at_ = 0;
  std::int64_t frame_ = 0;
};

/// Scans a second on the whole.
double rate_of(const std::vector<PointScan>& scans) {
  if (scans.size() < 2) return 1;
  return static_cast<double>(scans.back().frame - scans.front().frame) /
         (scans.back().time - scans.front().time);
}

/// Frames of one source, each with the points of its number, or, if the points have none, of its
/// time.
class PairedSource : public Source {
 public:
  PairedSource(std::unique_ptr<Source> frames, PointScans points, std::string path, Warn warn)
      : frames_(std::move(frames)),
        points_(std::move(points)),
        path_(std::move(path)),
        warn_(std::move(warn)) {}

  std::optional<SourceFrame> next() override {
    auto frame = frames_->next();
    if (!frame) {
      warn_of_rest();
      return std::nullopt;
    }
    if (at_ < points_.scans.size() && belongs(points_.scans[at_], frame->time)) {
      take(points_.scans[at_++], *frame);
    } else {
      // A file of times names every scan that there was, one of frames may leave empty ones out.
      frame->points.emplace(), frame->looked = points_.numbered;
    }
    ++frame_;
    return frame;
  }
  std::optional<std::int64_t> frame_count() const override { return frames_->frame_count(); }
  double frame_rate() const override { return frames_->frame_rate(); }

 private:
  /// Whether the next scan is this frame's. A scan of times alone is the frame's that lies at most
  /// half an interval away.
  bool belongs(const PointScan& scan, double time) const {
    if (points_.numbered) return scan.frame == frame_;
    constexpr double kRounding = 1e-6;
    const double reach = (0.5 + kRounding) / frames_->frame_rate();
    if (scan.time > time + reach) return false;
    if (scan.time >= time - reach) return true;
    throw std::runtime_error(fmt::format(
        "{}: the points at {} s belong to no frame (frame {} is at {} s, and of two scans near one "
        "frame only one can be its own); give the rows frame numbers",
        path_, scan.time, frame_, time));
  }

  void warn_of_rest() {
    const std::size_t rest = points_.scans.size() - std::exchange(at_, points_.scans.size());
    if (rest == 0) return;
    warn_(fmt::format("{}: {} scans of points come after the last frame and were not used", path_,
                      rest));
  }

  std::unique_ptr<Source> frames_;
  PointScans points_;
  std::string path_;
  Warn warn_;
  std::size_t at_ = 0;
  std::int64_t frame_ = 0;
};

}  // namespace

std::unique_ptr<Source> open_points(const std::string& path, std::optional<double> frame_rate) {
  std::vector<PointScan> scans = read_point_scans(path, 1 / frame_rate.value_or(1)).scans;
  const double rate = frame_rate.value_or(rate_of(scans));
  return std::make_unique<PointsSource>(std::move(scans), rate);
}

std::unique_ptr<Source> with_points(std::unique_ptr<Source> frames, const std::string& path,
                                    const Warn& warn) {
  PointScans points = read_point_scans(path, 1 / frames->frame_rate());
  return std::make_unique<PairedSource>(std::move(frames), std::move(points), path, warn);
}

}  // namespace glint
