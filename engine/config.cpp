// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/config.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "glint/engine/number_text.hpp"

namespace glint {
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

std::string value_text(const ConfigValue& value) {
  return std::visit(Overloaded{
                        [](bool b) { return std::string(b ? "true" : "false"); },
                        [](std::int64_t i) { return std::to_string(i); },
                        [](double x) { return number_text(x); },
                        [](const std::string& s) { return in_quotes(s); },
                    },
                    value);
}

[[noreturn]] void refuse(const ConfigField& field, const std::string& demand,
                         const ConfigValue& value) {
  throw ConfigError(field.key + " must be " + demand + ", got " + value_text(value));
}

std::optional<double> as_number(const ConfigValue& value) {
  if (const auto* i = std::get_if<std::int64_t>(&value)) return static_cast<double>(*i);
  if (const auto* x = std::get_if<double>(&value)) return *x;
  return std::nullopt;
}

double number_in_range(const ConfigField& field, const ConfigValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  if (field.automatic && text && *text == "auto") return field.low;
  const std::optional<double> x = as_number(value);
  if (!x) refuse(field, "a number in " + allowed(field), value);
  if (!(*x >= field.low && *x <= field.high)) refuse(field, "in " + allowed(field), value);
  return *x;
}

int whole_number_in_range(const ConfigField& field, const ConfigValue& value) {
  const double x = number_in_range(field, value);
  if (x != std::trunc(x)) refuse(field, "a whole number in " + allowed(field), value);
  return static_cast<int>(x);
}

const std::string& chosen(const ConfigField& field, const ConfigValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  const auto& choices = field.choices;
  if (text && (choices.empty() || std::ranges::find(choices, *text) != choices.end())) {
    return *text;
  }
  refuse(field, choices.empty() ? "a text in quotes" : allowed(field), value);
}

bool is_number(const ConfigField& field) {
  return std::holds_alternative<int*>(field.value) || std::holds_alternative<double*>(field.value);
}

template <class T>
std::optional<T> parse(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

void FieldList::operator()(std::string key, bool& value, std::string help) {
  fields_.push_back({std::move(key), &value, 0, 0, {}, {}, std::move(help)});
}

void FieldList::operator()(std::string key, int& value, int low, int high, std::string unit,
                           std::string help) {
  fields_.push_back({std::move(key),
                     &value,
                     static_cast<double>(low),
                     static_cast<double>(high),
                     {},
                     std::move(unit),
                     std::move(help)});
}

void FieldList::operator()(std::string key, double& value, double low, double high,
                           std::string unit, std::string help) {
  fields_.push_back({std::move(key), &value, low, high, {}, std::move(unit), std::move(help)});
}

void FieldList::automatic(std::string key, double& value, double low, double high, std::string unit,
                          std::string help) {
  (*this)(std::move(key), value, low, high, std::move(unit), std::move(help));
  fields_.back().automatic = true;
}

void FieldList::operator()(std::string key, std::string& value, std::vector<std::string> choices,
                           std::string help) {
  fields_.push_back({std::move(key), &value, 0, 0, std::move(choices), {}, std::move(help)});
}

void FieldList::add_choices(std::string key, ChosenValue value, std::vector<std::string> names,
                            std::string help) {
  fields_.push_back(
      {std::move(key), std::move(value), 0, 0, std::move(names), {}, std::move(help)});
}

void assign(ConfigField& field, const ConfigValue& value) {
  std::visit(Overloaded{
                 [&](bool* target) {
                   const auto* b = std::get_if<bool>(&value);
                   if (!b) refuse(field, allowed(field), value);
                   *target = *b;
                 },
                 [&](int* target) { *target = whole_number_in_range(field, value); },
                 [&](double* target) { *target = number_in_range(field, value); },
                 [&](std::string* target) { *target = chosen(field, value); },
                 [&](const ChosenValue& target) {
                   const auto at = std::ranges::find(field.choices, chosen(field, value));
                   target.choose(static_cast<std::size_t>(at - field.choices.begin()));
                 },
             },
             field.value);
}

void check(const ConfigField& field) {
  std::visit(Overloaded{
                 [](const bool*) {},
                 [&](const int* value) { number_in_range(field, std::int64_t{*value}); },
                 [&](const double* value) { number_in_range(field, *value); },
                 [&](const std::string* value) { chosen(field, *value); },
                 [&](const ChosenValue& value) {
                   if (!value.index()) refuse(field, allowed(field), std::string("another value"));
                 },
             },
             field.value);
}

void ConfigSection::refuse_type() const {
  throw ConfigError(
      "section [" + name_ +
      "] holds the settings of something else: take the section that the tracker's own "
      "entry makes, find_tracker(name).config()");
}

void assign_text(ConfigField& field, const std::string& text) {
  ConfigValue value = text;
  if (std::holds_alternative<bool*>(field.value)) {
    if (text == "true" || text == "false") value = text == "true";
  } else if (is_number(field)) {
    if (const auto whole = parse<std::int64_t>(text)) {
      value = *whole;
    } else if (const auto real = parse<double>(text)) {
      value = *real;
    }
  }
  assign(field, value);
}

std::string to_toml(const ConfigField& field) {
  return std::visit(Overloaded{
                        [](const bool* b) { return value_text(*b); },
                        [](const int* i) { return value_text(std::int64_t{*i}); },
                        [&](const double* x) {
                          if (field.automatic && *x == field.low) return in_quotes("auto");
                          const std::string text = number_text(*x);
                          const bool whole =
                              text.find_first_not_of("-0123456789") == std::string::npos;
                          return whole ? text + ".0" : text;
                        },
                        [](const std::string* s) { return in_quotes(*s); },
                        [&](const ChosenValue& value) {
                          check(field);
                          return in_quotes(field.choices.at(*value.index()));
                        },
                    },
                    field.value);
}

std::string allowed(const ConfigField& field) {
  if (std::holds_alternative<bool*>(field.value)) return "true or false";
  if (is_number(field)) {
    const std::string range = "[" + number_text(field.low) + ", " + number_text(field.high) + "]";
    return field.automatic ? range + " or auto" : range;
  }
  std::string text;
  for (std::size_t i = 0; i < field.choices.size(); ++i) {
    if (i > 0) text += i + 1 == field.choices.size() ? " or " : ", ";
    text += field.choices[i];
  }
  return text;
}

}  // namespace glint
