// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string>

#include "glint/engine/config.hpp"

namespace glint::cli {

/// Sets what a file says: TOML, or a track file of any format, whose header or sidecar holds the
/// configuration of the run that wrote it. Throws as read_toml() does.
void read_config(const std::string& path, std::span<ConfigSection> sections);

/// What --profile takes: the names, and what each is for.
std::string profile_help();

}  // namespace glint::cli
