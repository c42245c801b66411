// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <variant>
#include <vector>

#include "glint/engine/errors.hpp"

namespace glint {

/// One of the values of a setting that is an enumeration, and its name in files.
template <class Enum>
struct Choice {
  std::string name;
  Enum value;
};

/// A setting that is an enumeration, by the index of its value among the field's choices.
struct ChosenValue {
  std::function<std::optional<std::size_t>()> index;  ///< nothing for a value that is no choice
  std::function<void(std::size_t)> choose;
};

/// One setting of a config struct, by reference: where it lives, what it may be, what it means.
/// TOML files, --set, --help, `glint config` and the docs all come from a config's list of these.
struct ConfigField {
  std::string key;  ///< e.g. "birth_particles"
  std::variant<bool*, int*, double*, std::string*, ChosenValue> value;
  double low = 0, high = 0;          ///< numbers: allowed range, ends included
  std::vector<std::string> choices;  ///< strings and enumerations: allowed values; empty = any text
  std::string unit, help;            ///< unit may be empty
  bool automatic = false;            ///< numbers: the text "auto" stands for `low`
};

/// Collects the fields of a config struct; `describe(FieldList&, Config&)` calls it once a field.
class FieldList {
 public:
  void operator()(std::string key, bool& value, std::string help);
  void operator()(std::string key, int& value, int low, int high, std::string unit,
                  std::string help);
  void operator()(std::string key, double& value, double low, double high, std::string unit,
                  std::string help);
  void operator()(std::string key, std::string& value, std::vector<std::string> choices,
                  std::string help);
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const std::string& key, Enum& value,
                  std::initializer_list<Choice<std::type_identity_t<Enum>>> choices,
                  const std::string& help) {
    std::vector<std::string> names;
    std::vector<Enum> values;
    for (const auto& choice : choices) names.push_back(choice.name), values.push_back(choice.value);
    const auto index = [&value, values]() -> std::optional<std::size_t> {
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] == value) return i;
      }
      return std::nullopt;
    };
    const auto choose = [&value, values](std::size_t i) { value = values.at(i); };
    add_choices(key, {index, choose}, std::move(names), help);
  }
  /// A number whose least value means that it is found from the data; written and read as "auto".
  void automatic(std::string key, double& value, double low, double high, std::string unit,
                 std::string help);
  std::vector<ConfigField>& fields() { return fields_; }

 private:
  void add_choices(std::string key, ChosenValue value, std::vector<std::string> names,
                   std::string help);

  std::vector<ConfigField> fields_;
};

/// A value as a file or a command line gives it.
using ConfigValue = std::variant<bool, std::int64_t, double, std::string>;

/// Sets a field. Integers are taken for floating-point fields, and whole floating-point numbers
/// (1e5) for integers. Throws ConfigError ("birth_particles must be in [1, 1e7], got 0") for a
/// wrong type, range or choice; the field keeps its value then.
void assign(ConfigField& field, const ConfigValue& value);
/// Throws ConfigError like assign() unless the field's present value is allowed.
void check(const ConfigField& field);
/// The config itself, checked: what constructors take their settings by, wherever these come from.
/// Throws ConfigError for a value out of its range and for one that is no choice.
template <class C>
C valid(C config) {
  FieldList list;
  describe(list, config);
  for (const ConfigField& field : list.fields()) check(field);
  return config;
}
/// Reads `text` as the field's type and sets it (for --set).
void assign_text(ConfigField& field, const std::string& text);
/// The field's present value as TOML; reads back as exactly the same value.
std::string to_toml(const ConfigField& field);
/// What the field takes: "[1, 1e7]", "bright, dark or both", "true or false"; empty for any text.
std::string allowed(const ConfigField& field);

/// A named section of settings ("frames", "trackers.smc-phd") that owns its struct.
class ConfigSection {
 public:
  template <class C>
  static ConfigSection of(std::string name, C config = {}) {
    auto owned = std::make_shared<C>(std::move(config));
    FieldList list;
    describe(list, *owned);
    ConfigSection s;
    s.name_ = std::move(name);
    s.fields_ = std::move(list.fields());
    s.owned_ = owned;
    s.type_ = &typeid(C);
    return s;
  }
  const std::string& name() const { return name_; }
  std::vector<ConfigField>& fields() { return fields_; }
  const std::vector<ConfigField>& fields() const { return fields_; }
  /// The struct. Throws ConfigError if the section is of another type: settings of another tracker.
  template <class C>
  const C& as() const {
    if (*type_ != typeid(C)) refuse_type();
    return *static_cast<const C*>(owned_.get());
  }

 private:
  [[noreturn]] void refuse_type() const;

  std::string name_;
  const std::type_info* type_ = nullptr;
  std::vector<ConfigField> fields_;
  std::shared_ptr<void> owned_;
};

}  // namespace glint
