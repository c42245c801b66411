// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "glint/engine/config.hpp"
#include "glint/engine/scheduler.hpp"
#include "glint/frontends/files/raw_stream.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint {

struct SourceOptions {
  std::optional<double> frame_rate;  ///< [1/s]; without it the input's own, or 1 where it has none
  std::uint64_t seed = 1;            ///< of scenes
  std::optional<RawFormat> raw;      ///< inputs are frames without a header
  const ConfigSection* scene = nullptr;  ///< settings of the scene; nullptr = its defaults
  Warn warn = [](const std::string&) {};
};

/// The name in "scene:NAME", or nothing.
std::optional<std::string_view> scene_name(std::string_view input);

/// Opens videos, images (sequences by folder, printf pattern or list; multi-page TIFF), FITS files
/// and cubes, .npy cubes, one file of points (open_points()), one stream of raw frames ("-" is
/// standard input), or one "scene:NAME"; several inputs of frames follow one another. 16-bit pixels
/// arrive as 16-bit. Throws UsageError for inputs that are not there or of no known kind, and
/// std::runtime_error for damaged ones, here or from next(); the messages name the file.
std::unique_ptr<Source> open_source(std::span<const std::string> inputs,
                                    const SourceOptions& options = {});

}  // namespace glint
