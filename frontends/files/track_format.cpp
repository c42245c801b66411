// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "glint/engine/number_text.hpp"
#include "glint/frontends/files/tables.hpp"
#include "glint/frontends/files/track_file.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint {
namespace {

constexpr std::array<std::string_view, 9> kValueNames{
    "x", "y", "vx", "vy", "intensity", "existence", "var_x", "cov_xy", "var_y"};

std::array<double, 9> values_of(const TrackPoint& p) {
  return {p.x, p.y, p.vx, p.vy, p.intensity, p.existence, p.var_x, p.cov_xy, p.var_y};
}

/// Of a position: to a thousandth, and to a tenth of its spread.
int decimals_of(double variance) {
  constexpr double kLeast = 3, kMost = 17;
  if (!(variance > 0)) return static_cast<int>(kLeast);
  return static_cast<int>(std::clamp(std::ceil(1 - std::log10(variance) / 2), kLeast, kMost));
}

/// Empty for NaN.
void append_cell(std::string& row, double value, int decimals = 0) {
  row += ',';
  if (!std::isnan(value)) append_rounded(row, value, 8, decimals);
}

using Estimates = std::vector<std::string>;

std::string estimate_lines(const char* mark, const Estimates* estimated) {
  if (estimated == nullptr) return fmt::format("{} estimated: nothing yet\n", mark);
  std::string text;
  for (const std::string& line : *estimated) text += fmt::format("{} estimated: {}\n", mark, line);
  return text;
}

class CsvFormat : public TrackFormat {
 public:
  explicit CsvFormat(bool covariance) : covariance_(covariance) {}
  std::string header(const RunRecord& run, const Estimates* estimated) const override {
    const std::string title =
        "tracks of " + run.tracker + "; to repeat the run: glint track INPUT --config THIS_FILE";
    return comment_lines(run.config, title) + estimate_lines("##", estimated);
  }
  std::string padding(std::size_t bytes) const override {
    constexpr std::size_t kLine = 80;
    std::string text;
    while (bytes > 0) {
      const std::size_t line = bytes >= 2 * kLine ? kLine : bytes;
      text += "##" + std::string(line - 3, ' ') + '\n';
      bytes -= line;
    }
    return text;
  }
  std::string columns(const std::vector<std::string>& modes) override {
    std::string text = "frame,time,track_id,status";
    for (const auto column : kValueNames) text.append(",").append(column);
    if (covariance_) {
      for (const auto column : kVelocityCovarianceNames) text.append(",").append(column);
    }
    for (const auto& mode : modes) text += ",p_" + mode;
    return text + '\n';
  }
  std::string point(const TrackPoint& p) const override {
    std::string row = std::to_string(p.frame) + ',';
    append_rounded(row, p.time, 9, 6);
    row += fmt::format(",{},{}", p.track_id, name(p.status));
    append_cell(row, p.x, decimals_of(p.var_x)), append_cell(row, p.y, decimals_of(p.var_y));
    const auto values = values_of(p);
    for (std::size_t i = 2; i < values.size(); ++i) append_cell(row, values[i]);
    if (covariance_) {
      for (const double value : velocity_covariance(p)) append_cell(row, value);
    }
    for (const double probability : p.mode_probability) append_cell(row, probability);
    return row + '\n';
  }
  std::string trailer(const Estimates& estimated) const override {
    return estimate_lines("##", &estimated);
  }

 private:
  bool covariance_;
};

/// One object a line: first the run with what was estimated, then a point each under the names of
/// tracks.csv. Unknown values are null. Where the first line has no room, the estimates come last.
class JsonLinesFormat : public TrackFormat {
 public:
  std::string header(const RunRecord& run, const Estimates* estimated) const override {
    nlohmann::ordered_json line = {
        {"glint", GLINT_VERSION}, {"tracker", run.tracker}, {"config", run.config}};
    line["estimated"] = estimated != nullptr ? nlohmann::ordered_json(*estimated) : nullptr;
    return line.dump();
  }
  std::string padding(std::size_t bytes) const override {
    return std::string(bytes - 1, ' ') + '\n';
  }
  std::string columns(const std::vector<std::string>& modes) override {
    modes_ = modes;
    return {};
  }
  std::string point(const TrackPoint& p) const override {
    nlohmann::ordered_json line = {
        {"frame", p.frame}, {"time", p.time}, {"track_id", p.track_id}, {"status", name(p.status)}};
    add(kValueNames, values_of(p), line);
    add(kVelocityCovarianceNames, velocity_covariance(p), line);
    for (std::size_t i = 0; i < p.mode_probability.size() && i < modes_.size(); ++i) {
      line["p_" + modes_[i]] = p.mode_probability[i];
    }
    return line.dump() + '\n';
  }
  std::string trailer(const Estimates& estimated) const override {
    return nlohmann::ordered_json{{"estimated", estimated}}.dump() + '\n';
  }

 private:
  template <std::size_t N>
  static void add(const std::array<std::string_view, N>& names, const std::array<double, N>& values,
                  nlohmann::ordered_json& line) {
    for (std::size_t i = 0; i < N; ++i) line[std::string(names[i])] = values[i];  // NaN: null
  }

  std::vector<std::string> modes_;
};

/// MOTChallenge: confirmed points only, as boxes about the target; the format has no comments.
class MotFormat : public TrackFormat {
 public:
  std::string header(const RunRecord&, const Estimates*) const override { return {}; }
  std::string padding(std::size_t) const override { return {}; }
  std::string columns(const std::vector<std::string>&) override { return {}; }
  std::string point(const TrackPoint& p) const override {
    if (p.status != TrackStatus::confirmed) return {};
    constexpr double kSide = 7;  // [px], +-3 sigma of the default point spread
    const double confidence = std::isnan(p.existence) ? 1 : p.existence;
    // frames count from 1, and so do pixels: the first one's centre is (1, 1)
    std::string row = fmt::format("{},{}", p.frame + 1, p.track_id);
    append_cell(row, p.x + 1 - kSide / 2, decimals_of(p.var_x));
    append_cell(row, p.y + 1 - kSide / 2, decimals_of(p.var_y));
    return row + fmt::format(",{},{},{:.6g},-1,-1,-1\n", kSide, kSide, confidence);
  }
  std::string trailer(const Estimates&) const override { return {}; }
  bool bare() const override { return true; }
};

}  // namespace

std::unique_ptr<TrackFormat> track_format(const std::string& path, bool covariance) {
  if (path.ends_with(".csv")) return std::make_unique<CsvFormat>(covariance);
  if (path.ends_with(".jsonl") || path == kStandardOutput) {
    return std::make_unique<JsonLinesFormat>();
  }
  if (path.ends_with(".txt")) return std::make_unique<MotFormat>();
  throw UsageError(path + ": unknown track format; end the name in .csv, .jsonl or .mot.txt");
}

std::string sidecar_path(const std::string& path) { return path + ".toml"; }

std::string sidecar_text(const RunRecord& run, const std::vector<std::string>* estimated) {
  return fmt::format(
             "# glint {}, tracks of {}; to repeat the run: glint track INPUT --config THIS_FILE\n",
             GLINT_VERSION, run.tracker) +
         estimate_lines("#", estimated) + run.config;
}

}  // namespace glint
