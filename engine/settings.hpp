// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "glint/engine/config.hpp"

namespace glint {

/// A setting as programs give it: {"snr_low", 6}, {"frames.polarity", "dark"}, {"ring", false}.
struct Setting {
  std::string key;
  ConfigValue value;

  Setting(std::string name, ConfigValue given) : key(std::move(name)), value(std::move(given)) {}
  template <std::integral Number>
  requires(!std::same_as<Number, bool>) Setting(std::string name, Number given)
      : key(std::move(name)), value(static_cast<std::int64_t>(given)) {}
};
using Settings = std::vector<Setting>;

/// A field and the section that it stands in.
struct FoundSetting {
  ConfigSection* section = nullptr;
  ConfigField* field = nullptr;
  std::string key() const { return section->name() + '.' + field->key; }
};

/// The setting whose full key ("trackers.smc-phd.birth_particles") is `key` or ends in ".<key>"; a
/// full match goes before the others. Throws ConfigError for none, with the nearest known key, and
/// for several, with their full keys.
FoundSetting find_setting(std::string_view key, std::span<ConfigSection> sections);

/// Throws ConfigError for a section [name] that is not among `sections`, with the nearest one.
[[noreturn]] void refuse_section(std::string_view name, std::span<ConfigSection> sections);

/// Sets the setting that `key` stands for, as find_setting() takes it. Throws ConfigError for that
/// and for a value that the field refuses.
void apply_value(std::string_view key, const ConfigValue& value, std::span<ConfigSection> sections);

/// Carries out --set: `assignment` is "key=value", the key as find_setting() takes it. Throws
/// ConfigError for a missing =, an unknown or ambiguous key, and a value that the field refuses.
void apply_set(std::string_view assignment, std::span<ConfigSection> sections);

}  // namespace glint
