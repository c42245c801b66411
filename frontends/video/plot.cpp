// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/video/plot.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace glint {
namespace {

constexpr int kPanelWidth = 440, kPanelHeight = 300;
constexpr int kLeft = 56, kRight = 16, kTop = 30, kBottom = 46;  // margins about the axes [px]
constexpr int kLegendRow = 24, kLegendColumn = 220;
const cv::Scalar kInk(40, 40, 40), kGrid(225, 225, 225), kPaper(255, 255, 255);

// Colours that colour-blind people can tell apart (Okabe and Ito), BGR.
const std::array<cv::Scalar, 7> kColours{cv::Scalar(178, 114, 0), cv::Scalar(0, 94, 213),
                                         cv::Scalar(115, 158, 0), cv::Scalar(167, 121, 204),
                                         cv::Scalar(0, 159, 230), cv::Scalar(233, 180, 86),
                                         cv::Scalar(66, 228, 240)};

void write_text(cv::Mat& image, const std::string& text, cv::Point at, double align) {
  int baseline = 0;
  const cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 0.42, 1, &baseline);
  at.x -= static_cast<int>(align * size.width);
  cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.42, kInk, 1, cv::LINE_AA);
}

/// 1, 2 or 5 times a power of ten, so that about five steps make up `range`.
double tick_step(double range) {
  const double rough = range / 5, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) return factor * power;
  }
  return 10 * power;
}

struct Axis {
  double end = 1, step = 0.2;  // from 0
};

Axis axis_for(std::span<const PlotLine> lines, std::vector<double> PlotLine::*values) {
  double end = 0;
  for (const PlotLine& line : lines) {
    for (const double v : line.*values) end = v > end ? v : end;
  }
  if (end <= 0) return {};
  const double step = tick_step(end);
  return {step * std::ceil(end / step - 1e-9), step};
}

/// A panel's place in the image and its scales.
struct Canvas {
  cv::Mat image;  // the panel's part
  Axis x, y;

  cv::Point2d at(double px, double py) const {
    const double width = kPanelWidth - kLeft - kRight, height = kPanelHeight - kTop - kBottom;
    return {kLeft + width * px / x.end, kTop + height * (1 - py / y.end)};
  }
};

void draw_axes(Canvas& canvas, const PlotPanel& panel) {
  const auto tick_text = [](double value) { return fmt::format("{:.6g}", value); };
  for (int i = 0; i * canvas.x.step <= canvas.x.end * (1 + 1e-9); ++i) {
    const cv::Point2d p = canvas.at(i * canvas.x.step, 0);
    cv::line(canvas.image, p, canvas.at(i * canvas.x.step, canvas.y.end), kGrid);
    write_text(canvas.image, tick_text(i * canvas.x.step), p + cv::Point2d(0, 16), 0.5);
  }
  for (int i = 0; i * canvas.y.step <= canvas.y.end * (1 + 1e-9); ++i) {
    const cv::Point2d p = canvas.at(0, i * canvas.y.step);
    cv::line(canvas.image, p, canvas.at(canvas.x.end, i * canvas.y.step), kGrid);
    write_text(canvas.image, tick_text(i * canvas.y.step), p + cv::Point2d(-6, 4), 1);
  }
  cv::line(canvas.image, canvas.at(0, 0), canvas.at(canvas.x.end, 0), kInk);
  cv::line(canvas.image, canvas.at(0, 0), canvas.at(0, canvas.y.end), kInk);
  write_text(canvas.image, panel.x_label, {(kLeft + kPanelWidth) / 2, kPanelHeight - 10}, 0.5);
  const std::string title = panel.title + (panel.title.empty() ? "" : "   ") + panel.y_label;
  write_text(canvas.image, title, {kLeft, kTop - 10}, 0);
}

void draw_line(Canvas& canvas, const PlotLine& line, const cv::Scalar& colour) {
  constexpr int kShift = 4;  // OpenCV's fixed point, for smooth lines
  const auto fixed = [](cv::Point2d p) {
    return cv::Point(static_cast<int>(std::lround(p.x * (1 << kShift))),
                     static_cast<int>(std::lround(p.y * (1 << kShift))));
  };
  for (std::size_t i = 1; i < line.y.size(); ++i) {
    if (std::isnan(line.y[i - 1]) || std::isnan(line.y[i])) continue;
    cv::line(canvas.image, fixed(canvas.at(line.x[i - 1], line.y[i - 1])),
             fixed(canvas.at(line.x[i], line.y[i])), colour, 2, cv::LINE_AA, kShift);
  }
}

std::vector<std::string> labels_of(std::span<const PlotPanel> panels) {
  std::vector<std::string> labels;
  for (const PlotPanel& panel : panels) {
    for (const PlotLine& line : panel.lines) {
      if (std::find(labels.begin(), labels.end(), line.label) == labels.end()) {
        labels.push_back(line.label);
      }
    }
  }
  return labels;
}

const cv::Scalar& colour_of(std::size_t label) { return kColours[label % kColours.size()]; }

void draw_legend(cv::Mat part, const std::vector<std::string>& labels) {
  const auto to_a_row = static_cast<std::size_t>(std::max(1, part.cols / kLegendColumn));
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const int x = static_cast<int>(i % to_a_row) * kLegendColumn + 20;
    const int y = static_cast<int>(i / to_a_row) * kLegendRow + 10;
    cv::line(part, {x, y}, {x + 24, y}, colour_of(i), 2, cv::LINE_AA);
    write_text(part, labels[i], {x + 32, y + 4}, 0);
  }
}

}  // namespace

void write_plot(const std::string& path, std::span<const PlotPanel> panels, int columns) {
  const std::vector<std::string> labels = labels_of(panels);
  const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
  const int width = columns * kPanelWidth, to_a_row = std::max(1, width / kLegendColumn);
  const int legend = (static_cast<int>(labels.size()) + to_a_row - 1) / to_a_row * kLegendRow;
  cv::Mat image(rows * kPanelHeight + legend, width, CV_8UC3, kPaper);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const PlotPanel& panel = panels[i];
    const int column = static_cast<int>(i) % columns, row = static_cast<int>(i) / columns;
    const cv::Rect place(column * kPanelWidth, row * kPanelHeight, kPanelWidth, kPanelHeight);
    Canvas canvas{image(place), axis_for(panel.lines, &PlotLine::x),
                  axis_for(panel.lines, &PlotLine::y)};
    draw_axes(canvas, panel);
    for (const PlotLine& line : panel.lines) {
      const auto label = std::find(labels.begin(), labels.end(), line.label);
      draw_line(canvas, line, colour_of(static_cast<std::size_t>(label - labels.begin())));
    }
  }
  draw_legend(image.rowRange(rows * kPanelHeight, image.rows), labels);
  if (!cv::imwrite(path, image)) {
    throw std::runtime_error(path + ": cannot be written; check the folder and its permissions");
  }
}

}  // namespace glint
