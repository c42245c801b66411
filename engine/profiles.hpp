// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string_view>

#include "glint/engine/config.hpp"

namespace glint {

/// Settings that go together, under a name: those of frames and of several trackers.
struct Profile {
  std::string_view name, summary;
  std::span<const std::string_view> settings;  ///< "section.key=value"
};

/// The one list of profiles.
std::span<const Profile> all_profiles();

/// Sets what the profile says; all else keeps its value. Throws ConfigError that lists the names if
/// there is no such profile.
void apply_profile(std::string_view name, std::span<ConfigSection> sections);

}  // namespace glint
