// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/cli/curves.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "glint/engine/number_text.hpp"
#include "glint/frontends/files/tables.hpp"
#include "glint/frontends/modules/video.hpp"

namespace glint::cli {
namespace {

template <class T>
void add_new(std::vector<T>& list, const T& value) {
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

std::vector<std::string> metrics_of(const ExperimentResult& result) {
  std::vector<std::string> metrics;
  for (const Curve& curve : result.curves) add_new(metrics, curve.metric);
  return metrics;
}

/// Curves of the same level and condition, in the order of their coming.
std::vector<std::vector<const Curve*>> tables_of(const ExperimentResult& result) {
  std::vector<std::vector<const Curve*>> tables;
  for (const Curve& curve : result.curves) {
    const auto same = std::find_if(tables.begin(), tables.end(), [&](const auto& table) {
      return table[0]->level == curve.level && table[0]->condition == curve.condition;
    });
    if (same == tables.end()) {
      tables.push_back({&curve});
    } else {
      same->push_back(&curve);
    }
  }
  return tables;
}

std::string row_of(const std::vector<const Curve*>& table, std::size_t frame,
                   const std::vector<std::string>& metrics) {
  const Curve& first = *table.front();
  std::string row = number_text(first.frame[frame]) + "," + in_quotes(first.condition) + "," +
                    in_quotes(first.level);
  for (const std::string& metric : metrics) {
    row += ',';
    for (const Curve* curve : table) {
      const bool here = curve->metric == metric && !std::isnan(curve->value[frame]);
      if (here) append_number(row, curve->value[frame]);
    }
  }
  return row;
}

/// A column's name, with its unit.
std::string axis_label(const std::string& metric) {
  if (metric == "ospa") return "OSPA [px]";
  if (metric == "rmse") return "RMSE [px]";
  if (metric == "n") return "expected number of targets";
  if (metric == "p") return "model probability";
  return metric;
}

}  // namespace

void write_curves(const std::string& path, const ExperimentResult& result) {
  const std::vector<std::string> metrics = metrics_of(result);
  std::ofstream file = open_output(path);
  file << "# " << result.name << ", " << result.runs << " runs, seed " << result.seed << '\n';
  file << "frame,condition,level";
  for (const std::string& metric : metrics) file << ',' << metric;
  file << '\n';
  for (const auto& table : tables_of(result)) {
    for (std::size_t k = 0; k < table.front()->frame.size(); ++k) {
      file << row_of(table, k, metrics) << '\n';
    }
  }
  flush_output(file, path);
}

std::vector<PlotRow> plot_of(const ExperimentResult& result) {
  std::vector<PlotRow> rows;
  for (const std::string& metric : metrics_of(result)) {
    PlotRow row{"frame", axis_label(metric), metric == "n", {}};
    for (const Curve& curve : result.curves) {
      if (curve.metric != metric) continue;
      auto panel = std::ranges::find(row.panels, curve.level, &PlotPanel::title);
      if (panel == row.panels.end()) panel = row.panels.insert(panel, {curve.level, {}});
      panel->lines.push_back({curve.condition, curve.frame, curve.value});
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

void plot_curves(const std::string& path, const ExperimentResult& result) {
  const std::vector<PlotRow> rows = plot_of(result);
  if (has_video() && !rows.empty()) video().write_plot(path, rows);
}

}  // namespace glint::cli
