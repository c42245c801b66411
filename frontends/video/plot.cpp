// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/video/plot.hpp"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "glint/frontends/video/plot_panel.hpp"

namespace glint {
namespace {

constexpr int kPanelWidth = 440, kPanelHeight = 300, kMostColumns = 4;  // [px]
constexpr int kMargin = 20, kKey = 26, kGap = 24, kLegendLine = 24;     // of the legends [px]
const cv::Scalar kPaper(255, 255, 255);

using Labels = std::vector<std::string>;

void add_labels(const PlotRow& row, Labels& labels) {
  for (const PlotPanel& panel : row.panels) {
    for (const PlotLine& line : panel.lines) {
      if (std::ranges::find(labels, line.label) == labels.end()) labels.push_back(line.label);
    }
  }
}

/// A row's panels in lines of equal length.
struct RowLines {
  int lines, columns;

  explicit RowLines(const PlotRow& row) {
    const int panels = static_cast<int>(row.panels.size());
    lines = (panels + kMostColumns - 1) / kMostColumns;
    columns = lines > 0 ? (panels + lines - 1) / lines : 0;
  }
};

/// Where an entry of a legend begins, from the legend's corner.
struct LegendEntry {
  std::string label;
  cv::Point at;
};

int entry_width(const std::string& label) { return kKey + 8 + text_width(label); }

std::vector<LegendEntry> legend_of(const PlotRow& row, int width) {
  Labels labels;
  add_labels(row, labels);
  std::vector<LegendEntry> entries;
  cv::Point at(kMargin, kLegendLine / 2);
  for (const std::string& label : labels) {
    const bool fits = at.x + entry_width(label) + kMargin <= width;
    if (!fits && at.x > kMargin) at = {kMargin, at.y + kLegendLine};
    entries.push_back({label, at});
    at.x += entry_width(label) + kGap;
  }
  return entries;
}

int legend_height(const std::vector<LegendEntry>& legend) {
  return legend.empty() ? 0 : legend.back().at.y + kLegendLine;
}

int width_of(std::span<const PlotRow> rows, const Labels& labels) {
  int width = kPanelWidth;
  for (const PlotRow& row : rows) width = std::max(width, RowLines(row).columns * kPanelWidth);
  for (const std::string& label : labels) width = std::max(width, entry_width(label) + 2 * kMargin);
  return width;
}

void draw_legend(cv::Mat part, const std::vector<LegendEntry>& legend, const Labels& labels) {
  for (const LegendEntry& entry : legend) {
    const auto label =
        static_cast<std::size_t>(std::ranges::find(labels, entry.label) - labels.begin());
    const cv::Point end = entry.at + cv::Point(kKey, 0);
    draw_stroke(part, entry.at, end, plot_style(label));
    write_text(part, entry.label, end + cv::Point(8, 4));
  }
}

void draw_panels(const cv::Mat& part, const PlotRow& row, const Labels& labels) {
  const PlotAxes axes = axes_of(row);
  const int columns = RowLines(row).columns, panels = static_cast<int>(row.panels.size());
  for (int i = 0; i < panels; ++i) {
    const int left = part.cols * (i % columns) / columns;
    const int right = part.cols * (i % columns + 1) / columns;
    const cv::Rect place(left, i / columns * kPanelHeight, right - left, kPanelHeight);
    draw_panel(part(place), row, row.panels[static_cast<std::size_t>(i)], axes, labels);
  }
}

}  // namespace

void write_plot(const std::string& path, std::span<const PlotRow> rows) {
  Labels labels;
  for (const PlotRow& row : rows) add_labels(row, labels);
  const int width = width_of(rows, labels);
  int height = 0;
  for (const PlotRow& row : rows) {
    height += RowLines(row).lines * kPanelHeight + legend_height(legend_of(row, width));
  }
  cv::Mat image(std::max(height, 1), width, CV_8UC3, kPaper);
  int top = 0;
  for (const PlotRow& row : rows) {
    const int legend_top = top + RowLines(row).lines * kPanelHeight;
    const std::vector<LegendEntry> legend = legend_of(row, width);
    draw_panels(image.rowRange(top, legend_top), row, labels);
    top = legend_top + legend_height(legend);
    draw_legend(image.rowRange(legend_top, top), legend, labels);
  }
  if (!cv::imwrite(path, image)) {
    throw std::runtime_error(path + ": cannot be written; check the folder and its permissions");
  }
}

}  // namespace glint
