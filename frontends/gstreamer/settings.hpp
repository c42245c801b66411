// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "glint/engine/config.hpp"

namespace glint::gstreamer {

/// The element's properties that choose settings; empty ones say nothing.
struct Properties {
  std::string tracker;      ///< names, separated by spaces
  std::string profile;      ///< its name
  std::string config_file;  ///< path of a TOML file
  std::string config;       ///< TOML text
  std::string set;          ///< key=value, separated by semicolons
  std::string device;
  bool overlay = false;
};

/// All sections with what the properties say; `set` goes before tracker and device, these before
/// config, then config_file, then profile. Without any tracker it is mm-phd. Throws UsageError and
/// ConfigError as what reads them does.
std::vector<ConfigSection> sections_of(const Properties& properties);

}  // namespace glint::gstreamer
