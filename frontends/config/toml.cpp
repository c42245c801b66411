// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/config/toml.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "glint/frontends/usage_error.hpp"

namespace glint {
namespace {

bool is_section_or_above(const std::string& path, std::span<const ConfigSection> sections) {
  return std::ranges::any_of(sections, [&](const ConfigSection& s) {
    return s.name() == path || s.name().starts_with(path + '.');
  });
}

ConfigValue value_of(const std::string& key, const toml::node& node) {
  if (const auto* b = node.as_boolean()) return b->get();
  if (const auto* i = node.as_integer()) return i->get();
  if (const auto* x = node.as_floating_point()) return x->get();
  if (const auto* s = node.as_string()) return s->get();
  throw ConfigError(key + " must be a single value, got " +
                    (node.is_array() ? "an array" : "a date or time"));
}

void set(const std::string& key, const toml::node& node, std::span<ConfigSection> sections) {
  const FoundSetting setting = find_setting(key, sections);
  if (setting.key() != key) {
    throw ConfigError("unknown key " + key + ": did you mean " + setting.key() + "?");
  }
  apply_value(key, value_of(key, node), sections);
}

[[noreturn]] void fail(const std::string& file, const toml::source_region& where,
                       std::string_view what) {
  throw ConfigError(file + ':' + std::to_string(where.begin.line) + ": " + std::string(what));
}

void read(const toml::table& table, const std::string& path, const std::string& file,
          std::span<ConfigSection> sections) {
  for (const auto& [key, node] : table) {
    const std::string full = (path.empty() ? "" : path + '.') + std::string(key);
    const toml::table* const inner = node.as_table();
    try {
      if (!inner) set(full, node, sections);
      if (inner && !is_section_or_above(full, sections)) refuse_section(full, sections);
    } catch (const ConfigError& e) {
      fail(file, key.source(), e.what());
    }
    if (inner) read(*inner, full, file, sections);
  }
}

std::string comment(const ConfigField& field) {
  const std::string range = allowed(field);
  std::string text = "# ";
  for (const char c : field.help) text += c == '\n' ? std::string("\n# ") : std::string(1, c);
  if (!field.unit.empty()) text += " [" + field.unit + ']';
  if (!range.empty()) text += "; " + range;
  return text + '\n';
}

}  // namespace

void parse_toml(std::string_view text, const std::string& name, std::span<ConfigSection> sections) {
  toml::table table;
  try {
    table = toml::parse(text);
  } catch (const toml::parse_error& e) {
    fail(name, e.source(), e.description());
  }
  read(table, "", name, sections);
}

void read_toml(const std::string& path, std::span<ConfigSection> sections) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) {
    const int reason = file ? EISDIR : errno;
    throw UsageError(path + " cannot be read (" + std::generic_category().message(reason) +
                     "): `glint config TRACKER > FILE.toml` writes one to begin with");
  }
  const std::string text(std::istreambuf_iterator<char>(file), {});
  parse_toml(text, path, sections);
}

std::string write_toml(std::span<const ConfigSection> sections) {
  std::string text;
  for (const ConfigSection& section : sections) {
    if (!text.empty()) text += '\n';
    text += '[' + section.name() + "]\n";
    for (const ConfigField& field : section.fields()) {
      text += comment(field) + field.key + " = " + to_toml(field) + '\n';
    }
  }
  return text;
}

}  // namespace glint
