// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/video/plot_panel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace glint {
namespace {

constexpr int kLeft = 56, kRight = 20, kTop = 32, kBottom = 46;  // margins about the axes [px]
constexpr double kFontScale = 0.45;
const cv::Scalar kInk(40, 40, 40), kGrid(225, 225, 225);

// Colours that colour-blind people can tell apart (Okabe and Ito), BGR.
const std::array<cv::Scalar, 7> kColours{cv::Scalar(178, 114, 0), cv::Scalar(0, 94, 213),
                                         cv::Scalar(115, 158, 0), cv::Scalar(167, 121, 204),
                                         cv::Scalar(0, 159, 230), cv::Scalar(233, 180, 86),
                                         cv::Scalar(0, 0, 0)};

/// A panel's place in the image and its scales.
struct Canvas {
  cv::Mat image;  // the panel's part
  PlotAxes axes;

  cv::Point2d at(double x, double y) const {
    const double width = image.cols - kLeft - kRight, height = image.rows - kTop - kBottom;
    return {kLeft + width * axes.x.place(x), kTop + height * (1 - axes.y.place(y))};
  }
};

void draw_axes(Canvas& canvas, const PlotRow& row, const PlotPanel& panel) {
  const PlotAxis &x = canvas.axes.x, &y = canvas.axes.y;
  const auto tick_text = [](double value) { return fmt::format("{:.6g}", value); };
  for (const double tick : x.ticks()) {
    cv::line(canvas.image, canvas.at(tick, y.first), canvas.at(tick, y.last), kGrid);
    write_text(canvas.image, tick_text(tick), canvas.at(tick, y.first) + cv::Point2d(0, 16), 0.5);
  }
  for (const double tick : y.ticks()) {
    cv::line(canvas.image, canvas.at(x.first, tick), canvas.at(x.last, tick), kGrid);
    write_text(canvas.image, tick_text(tick), canvas.at(x.first, tick) + cv::Point2d(-6, 4), 1);
  }
  const cv::Point2d origin = canvas.at(x.first, y.first);
  cv::line(canvas.image, origin, canvas.at(x.last, y.first), kInk);
  cv::line(canvas.image, origin, canvas.at(x.first, y.last), kInk);
  const int middle = (kLeft + canvas.image.cols - kRight) / 2;
  write_text(canvas.image, row.x_label, {middle, canvas.image.rows - 10}, 0.5);
  const std::string title = panel.title.empty() ? row.y_label : row.y_label + ": " + panel.title;
  write_text(canvas.image, title, {kLeft, kTop - 10});
}

void draw_line(Canvas& canvas, const PlotLine& line, const PlotStyle& style) {
  const auto point = [&](std::size_t i) { return canvas.at(line.x[i], line.y[i]); };
  double gone = 0;
  bool joined = false;  // to the point before
  for (std::size_t i = 0; i < line.y.size(); ++i) {
    if (std::isnan(line.y[i])) {
      joined = false;
      continue;
    }
    const bool goes_on = i + 1 < line.y.size() && !std::isnan(line.y[i + 1]);
    if (goes_on) gone = draw_stroke(canvas.image, point(i), point(i + 1), style, gone);
    if (!goes_on && !joined) {
      cv::circle(canvas.image, point(i), 2, style.colour, cv::FILLED, cv::LINE_AA);
    }
    joined = goes_on;
  }
}

}  // namespace

PlotStyle plot_style(std::size_t index) {
  return {kColours[index % kColours.size()], index / kColours.size() % 2 == 1};
}

int text_width(const std::string& text) {
  int base_line = 0;
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kFontScale, 1, &base_line).width;
}

void write_text(cv::Mat& image, const std::string& text, cv::Point at, double align) {
  at.x -= static_cast<int>(align * text_width(text));
  cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, kFontScale, kInk, 1, cv::LINE_AA);
}

double draw_stroke(cv::Mat& image, cv::Point2d at, cv::Point2d to, const PlotStyle& style,
                   double gone) {
  constexpr int kShift = 4;              // OpenCV's fixed point, for smooth lines
  constexpr double kDash = 7, kGap = 5;  // [px]
  const auto fixed = [](cv::Point2d p) {
    return cv::Point(static_cast<int>(std::lround(p.x * (1 << kShift))),
                     static_cast<int>(std::lround(p.y * (1 << kShift))));
  };
  const auto draw = [&](cv::Point2d from, cv::Point2d end) {
    cv::line(image, fixed(from), fixed(end), style.colour, 2, cv::LINE_AA, kShift);
  };
  const double length = std::hypot(to.x - at.x, to.y - at.y);
  if (!style.dashed) draw(at, to);
  for (double done = 0; style.dashed && done < length;) {
    const double phase = std::fmod(gone + done, kDash + kGap);
    const double piece = std::min(length - done, (phase < kDash ? kDash : kDash + kGap) - phase);
    const cv::Point2d way = (to - at) / length;
    if (phase < kDash) draw(at + way * done, at + way * (done + piece));
    done += std::max(piece, 0.01);  // the phase may round to a dash's end
  }
  return gone + length;
}

void draw_panel(const cv::Mat& part, const PlotRow& row, const PlotPanel& panel,
                const PlotAxes& axes, const std::vector<std::string>& labels) {
  Canvas canvas{part, axes};
  draw_axes(canvas, row, panel);
  for (const PlotLine& line : panel.lines) {
    const auto label = std::find(labels.begin(), labels.end(), line.label);
    draw_line(canvas, line, plot_style(static_cast<std::size_t>(label - labels.begin())));
  }
}

}  // namespace glint
