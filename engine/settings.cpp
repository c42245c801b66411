// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/settings.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "glint/engine/trimmed.hpp"

namespace glint {
namespace {

/// Least number of characters to add, remove or change to get from `a` to `b` (Levenshtein).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

/// The known name that `wanted` is most likely a slip of; empty if none is near.
std::string nearest(std::string_view wanted, std::span<const std::string> known) {
  std::size_t least = std::max<std::size_t>(2, wanted.size() / 4) + 1;
  std::string best;
  for (const std::string& name : known) {
    const std::size_t distance = edit_distance(wanted, name);
    if (distance >= least) continue;
    least = distance;
    best = name;
  }
  return best;
}

std::string_view last_part(std::string_view key) { return key.substr(key.rfind('.') + 1); }

std::vector<FoundSetting> all_settings(std::span<ConfigSection> sections) {
  std::vector<FoundSetting> settings;
  for (ConfigSection& section : sections) {
    for (ConfigField& field : section.fields()) settings.push_back({&section, &field});
  }
  return settings;
}

[[noreturn]] void refuse_key(std::string_view key, std::span<ConfigSection> sections) {
  const bool full = key.find('.') != std::string_view::npos;
  std::vector<std::string> known;
  std::string meant;  // the same key of another section, or a similar one of the same
  for (const FoundSetting& s : all_settings(sections)) {
    if (full && s.field->key == last_part(key)) meant = s.key();
    if (!full || key.starts_with(s.section->name() + '.')) {
      known.push_back(full ? s.key() : s.field->key);
    }
  }
  if (meant.empty()) meant = nearest(key, known);
  throw ConfigError("unknown key " + std::string(key) +
                    (meant.empty() ? ": `glint config TRACKER` shows all keys"
                                   : ": did you mean " + meant + "?"));
}

}  // namespace

FoundSetting find_setting(std::string_view key, std::span<ConfigSection> sections) {
  std::vector<FoundSetting> found;
  for (const FoundSetting& s : all_settings(sections)) {
    const std::string full = s.key();
    if (full == key) return s;
    if (full.ends_with('.' + std::string(key))) found.push_back(s);
  }
  if (found.empty()) refuse_key(key, sections);
  if (found.size() == 1) return found.front();
  std::string names;
  for (const FoundSetting& s : found) names += (names.empty() ? "" : ", ") + s.key();
  throw ConfigError("key " + std::string(key) + " is ambiguous: use one of " + names);
}

void refuse_section(std::string_view name, std::span<ConfigSection> sections) {
  std::vector<std::string> known;
  std::string all;
  for (const ConfigSection& section : sections) {
    known.push_back('[' + section.name() + ']');
    all += (all.empty() ? "" : ", ") + known.back();
  }
  const std::string wanted = '[' + std::string(name) + ']';
  const std::string meant = nearest(wanted, known);
  throw ConfigError("unknown section " + wanted +
                    (meant.empty() ? ": use " + all : ": did you mean " + meant + "?"));
}

void apply_value(std::string_view key, const ConfigValue& value,
                 std::span<ConfigSection> sections) {
  const FoundSetting setting = find_setting(key, sections);
  try {
    assign(*setting.field, value);
  } catch (const ConfigError& e) {
    throw ConfigError(setting.section->name() + '.' + e.what());
  }
}

void apply_set(std::string_view assignment, std::span<ConfigSection> sections) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) {
    throw ConfigError("'" + std::string(assignment) + "' is no setting: write key=value");
  }
  const FoundSetting setting = find_setting(trimmed(assignment.substr(0, equals)), sections);
  try {
    assign_text(*setting.field, std::string(trimmed(assignment.substr(equals + 1))));
  } catch (const ConfigError& e) {
    throw ConfigError(setting.section->name() + '.' + e.what());
  }
}

}  // namespace glint
