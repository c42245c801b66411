// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/csv.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "glint/engine/trimmed.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint {
namespace {

constexpr std::size_t kNoColumn = std::numeric_limits<std::size_t>::max();
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // spreadsheets write it

/// Without blanks about it, and without quotes.
std::string_view cell_text(std::string_view cell) {
  cell = trimmed(cell);
  const bool quoted = cell.size() >= 2 && cell.front() == '"' && cell.back() == '"';
  return quoted ? cell.substr(1, cell.size() - 2) : cell;
}

void split(std::string_view line, std::vector<std::string_view>& cells) {
  cells.clear();
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(cell_text(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

/// Where a column stands under any of its names, "one or another".
std::size_t locate(std::span<const std::string_view> header, std::string_view names) {
  constexpr std::string_view kOr = " or ";
  while (true) {
    const std::size_t end = names.find(kOr);
    const auto found = std::ranges::find(header, names.substr(0, end));
    if (found != header.end()) return static_cast<std::size_t>(found - header.begin());
    if (end == std::string_view::npos) return kNoColumn;
    names.remove_prefix(end + kOr.size());
  }
}

/// Where each wanted column stands; optional ones that are not there are kNoColumn.
std::vector<std::size_t> locate(const std::string& path, std::span<const std::string_view> header,
                                std::span<const std::string_view> columns, std::size_t required) {
  std::vector<std::size_t> at;
  std::vector<std::string_view> missing;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    at.push_back(locate(header, columns[i]));
    if (at.back() == kNoColumn && i < required) missing.push_back(columns[i]);
  }
  if (missing.empty()) return at;
  throw std::runtime_error(
      fmt::format("{}: no column {}; the header has {}: rename or add what is missing", path,
                  fmt::join(missing, ", "), fmt::join(header, ", ")));
}

}  // namespace

double CsvRow::number(std::size_t column) const {
  const std::string_view cell = cells_[column];
  if (cell.empty() || cell == "nan" || cell == "NaN") {
    return std::numeric_limits<double>::quiet_NaN();
  }
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size()) refuse(column, "a number");
  return value;
}

std::int64_t CsvRow::integer(std::size_t column) const {
  const double value = number(column);
  if (!(std::abs(value) < 0x1p53) || value != std::trunc(value)) refuse(column, "a whole number");
  return static_cast<std::int64_t>(value);
}

void CsvRow::refuse(std::size_t column, std::string_view must_be) const {
  throw std::runtime_error(fmt::format("{}:{}: {} must be {}, got '{}'", path_, line_,
                                       columns_[column], must_be, cells_[column]));
}

void read_csv(const std::string& path, std::span<const std::string_view> required,
              std::span<const std::string_view> optional,
              const std::function<void(const CsvRow&)>& f) {
  std::ifstream file(path);
  if (!file) throw UsageError(path + ": cannot be read; check the path");
  std::vector<std::string_view> columns(required.begin(), required.end());
  columns.insert(columns.end(), optional.begin(), optional.end());
  std::vector<std::string_view> cells, wanted(columns.size());
  std::vector<std::size_t> at;
  std::string line;
  for (std::int64_t number = 1; std::getline(file, line); ++number) {
    if (number == 1 && line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
    if (line.starts_with('#') || cell_text(line).empty()) continue;
    split(line, cells);
    if (at.empty()) {
      at = locate(path, cells, columns, required.size());
      continue;
    }
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (at[i] != kNoColumn && at[i] >= cells.size()) {
        throw std::runtime_error(
            fmt::format("{}:{}: has {} cells, too few to hold {}; is the file "
                        "complete?",
                        path, number, cells.size(), columns[i]));
      }
      wanted[i] = at[i] == kNoColumn ? std::string_view() : cells[at[i]];
    }
    f(CsvRow(path, number, columns, wanted));
  }
  if (at.empty()) throw std::runtime_error(path + ": is empty; expected a header line");
}

}  // namespace glint
