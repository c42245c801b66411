// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "glint/engine/metrics/evaluation.hpp"
#include "glint/engine/scenario/truth.hpp"
#include "glint/engine/tracks/track_log.hpp"
#include "glint/frontends/track_status.hpp"

namespace glint {

/// Tables by column name; see read_csv for what they throw. tracks.csv needs frame, track_id, x, y,
/// and takes status (confirmed if there is none), time, vx, vy, intensity, existence, var_x,
/// cov_xy, var_y and those of kVelocityCovarianceNames. Model probabilities are passed over.
std::vector<TrackPoint> read_tracks(const std::string& path);
/// Needs frame, track_id, x, y; takes vx, vy, intensity. Tables of labelled boxes do as they are:
/// frame0, linked_id, cx, cy are other names of the first four.
std::vector<TruthPoint> read_truth(const std::string& path);
/// Needs frame, x, y, amplitude.
std::vector<Detection> read_points(const std::string& path);

/// The name that stands for standard output.
inline constexpr std::string_view kStandardOutput = "-";
/// A file that is written from start to end, or standard output. Throws UsageError if it cannot be
/// opened.
std::ofstream open_output(const std::string& path);
/// Throws std::runtime_error if something could not be written.
void flush_output(std::ofstream& file, const std::string& path);

/// The comments that a table begins with: "## glint <version>, <title>", then the configuration as
/// TOML behind "# ", so that a program that strips one # a line has a configuration file.
std::string comment_lines(std::string_view config, std::string_view title);

/// Throws UsageError if the file cannot be written.
void write_truth(const std::string& path, std::span<const TruthPoint> truth,
                 std::string_view comments = {});

}  // namespace glint
