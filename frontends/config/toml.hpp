// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "glint/engine/config.hpp"
#include "glint/engine/settings.hpp"

namespace glint {

/// Sets what a TOML file says; all else keeps its value. An empty file says nothing. Throws
/// UsageError for a file that cannot be read and ConfigError for what does not fit, with file and
/// line: "file.toml:12: trackers.smc-phd.birth_particles must be in [1, 1e7], got 0".
void read_toml(const std::string& path, std::span<ConfigSection> sections);

/// The same from text; `name` stands for the file in messages.
void parse_toml(std::string_view text, const std::string& name, std::span<ConfigSection> sections);

/// All sections as a TOML file, with help, unit and range of each setting as a comment. Reads back
/// as exactly the same values.
std::string write_toml(std::span<const ConfigSection> sections);

}  // namespace glint
