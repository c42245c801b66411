// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "glint/engine/errors.hpp"

namespace glint {

/// One setting of a config struct, by reference: where it lives, what it may be, what it means.
/// TOML files, --set, --help, `glint config` and the docs all come from a config's list of these.
struct ConfigField {
  std::string key;  ///< e.g. "birth_particles"
  std::variant<bool*, int*, double*, std::string*> value;
  double low = 0, high = 0;          ///< numbers: allowed range, ends included
  std::vector<std::string> choices;  ///< strings: allowed values; empty = any
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
  /// A number whose least value means that it is found from the data; written and read as "auto".
  void automatic(std::string key, double& value, double low, double high, std::string unit,
                 std::string help);
  std::vector<ConfigField>& fields() { return fields_; }

 private:
  std::vector<ConfigField> fields_;
};

/// A value as a file or a command line gives it.
using ConfigValue = std::variant<bool, std::int64_t, double, std::string>;

/// Sets a field. Integers are taken for floating-point fields, and whole floating-point numbers
/// (1e5) for integers. Throws ConfigError ("birth_particles must be in [1, 1e7], got 0") for a
/// wrong type, range or choice; the field keeps its value then.
void assign(ConfigField& field, const ConfigValue& value);
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
    return s;
  }
  const std::string& name() const { return name_; }
  std::vector<ConfigField>& fields() { return fields_; }
  const std::vector<ConfigField>& fields() const { return fields_; }
  /// The struct; C must be the type it was made of.
  template <class C>
  const C& as() const {
    return *static_cast<const C*>(owned_.get());
  }

 private:
  std::string name_;
  std::vector<ConfigField> fields_;
  std::shared_ptr<void> owned_;
};

}  // namespace glint
