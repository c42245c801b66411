// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/video/painter.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

namespace glint {
namespace {

constexpr std::size_t kTail = 20;  // points
constexpr int kMaxScale = 4;
constexpr int kShift = 4;  // fraction bits of OpenCV's sub-pixel coordinates
constexpr int kLine = cv::LINE_AA;

cv::Point fixed_point(cv::Point2d p) {
  constexpr double kOne = 1 << kShift;
  return {static_cast<int>(std::lround(p.x * kOne)), static_cast<int>(std::lround(p.y * kOne))};
}

/// Hues a golden angle apart: neighbours in number are far apart in colour.
cv::Scalar colour_of(std::size_t tracker, std::int64_t track) {
  const double turns = 0.618034 * static_cast<double>(track) + 0.31 * static_cast<double>(tracker);
  const double hue = 6 * (turns - std::floor(turns));
  const auto channel = [hue](double centre) {
    const double away = std::abs(std::remainder(hue - centre, 6));
    return 70 + 185 * std::clamp(2 - away, 0.0, 1.0);
  };
  return {channel(4), channel(2), channel(0)};
}

/// The grey levels that a share `low` and `high` of a sample of the pixels lie below.
std::pair<double, double> quantiles(FrameView frame, double low, double high) {
  std::vector<float> sample;
  const int step =
      std::max(1, static_cast<int>(std::sqrt(frame.width * double{1} * frame.height) / 256));
  for (int y = 0; y < frame.height; y += step) {
    for (int x = 0; x < frame.width; x += step) {
      if (std::isfinite(frame(x, y))) sample.push_back(frame(x, y));
    }
  }
  if (sample.empty()) return {0, 1};
  const auto at = [&](double share) {
    const auto nth = sample.begin() +
                     static_cast<std::ptrdiff_t>(share * static_cast<double>(sample.size() - 1));
    std::nth_element(sample.begin(), nth, sample.end());
    return static_cast<double>(*nth);
  };
  return {at(low), at(high)};
}

}  // namespace

void Painter::follow(std::span<const std::vector<TrackPoint>> reported) {
  Tails now;
  for (std::size_t tracker = 0; tracker < reported.size(); ++tracker) {
    for (const TrackPoint& point : reported[tracker]) {
      if (point.status == TrackStatus::halted) continue;
      std::deque<TrackPoint>& tail = now[{tracker, point.track_id}];
      const auto before = tails_.find({tracker, point.track_id});
      if (before != tails_.end()) tail = std::move(before->second);
      tail.push_back(point);
      if (tail.size() > kTail) tail.pop_front();
    }
  }
  tails_ = std::move(now);
}

cv::Mat Painter::grey(FrameView frame, double steady) {
  auto [low, high] = quantiles(frame, 0.005, 0.9985);
  if (high_ > low_) {
    low = steady * low_ + (1 - steady) * low;
    high = steady * high_ + (1 - steady) * high;
  }
  low_ = low, high_ = std::max(high, low + 1e-9 * (1 + std::abs(low)));
  const cv::Mat pixels(frame.height, frame.width, CV_32F, const_cast<float*>(frame.data),
                       static_cast<std::size_t>(frame.pitch) * sizeof(float));
  cv::Mat stretched, picture;
  const double gain = 235 / (high_ - low_);
  pixels.convertTo(stretched, CV_8U, gain, 10 - gain * low_);
  scale_ = std::clamp((width_ + frame.width - 1) / std::max(1, frame.width), 1, kMaxScale);
  cv::resize(stretched, stretched, {}, scale_, scale_, cv::INTER_CUBIC);
  cv::cvtColor(stretched, picture, cv::COLOR_GRAY2BGR);
  return picture;
}

cv::Point2d Painter::on_picture(const TrackPoint& p) const {
  return {(p.x + 0.5) * scale_ - 0.5, (p.y + 0.5) * scale_ - 0.5};
}

void Painter::draw(cv::Mat& picture, const Tails& tails) const {
  for (const auto& [key, tail] : tails) {
    const TrackPoint& head = tail.back();
    if (head.status != TrackStatus::confirmed) continue;
    const cv::Scalar colour = colour_of(key.first, key.second);
    for (std::size_t i = 1; i < tail.size(); ++i) {
      const double fade = 0.35 + 0.65 * static_cast<double>(i) / static_cast<double>(tail.size());
      cv::line(picture, fixed_point(on_picture(tail[i - 1])), fixed_point(on_picture(tail[i])),
               colour * fade, scale_ > 1 ? 2 : 1, kLine, kShift);
    }
    const cv::Point2d at = on_picture(head);
    const double radius = 4.0 * scale_ + 2;
    cv::circle(picture, fixed_point(at), static_cast<int>(radius * (1 << kShift)), colour,
               scale_ > 1 ? 2 : 1, kLine, kShift);
    const cv::Point corner(static_cast<int>(at.x + radius), static_cast<int>(at.y - radius));
    const std::string label = std::to_string(key.second);
    const double size = scale_ > 1 ? 0.55 : 0.4;
    cv::putText(picture, label, corner, cv::FONT_HERSHEY_SIMPLEX, size, {0, 0, 0}, 3, kLine);
    cv::putText(picture, label, corner, cv::FONT_HERSHEY_SIMPLEX, size, colour, 1, kLine);
  }
}

}  // namespace glint
