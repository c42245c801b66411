// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "glint/engine/config.hpp"

namespace glint::python {

/// Settings by key, as find_setting() takes it.
using Values = std::vector<std::pair<std::string, ConfigValue>>;

/// What an engine is made from; later parts go before earlier ones.
struct Request {
  std::optional<std::string> profile;
  std::string config_text;  ///< TOML
  Values config;
  std::optional<std::string>
      trackers;  ///< names, separated by spaces; else the config's, or mm-phd
  Values settings;
};

/// All sections with what the request says. A key that is not a full one is looked for in the
/// sections that the trackers use. Throws ConfigError and UsageError.
std::vector<ConfigSection> sections_of(const Request& request);

/// The scene's section with `values` set. Throws ConfigError.
ConfigSection scene_section(const std::string& scene, const Values& values);

}  // namespace glint::python
