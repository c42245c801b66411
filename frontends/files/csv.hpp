// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

/// One row of a CSV file; cells are in the order of the columns asked for.
class CsvRow {
 public:
  CsvRow(const std::string& path, std::int64_t line, std::span<const std::string_view> columns,
         std::span<const std::string_view> cells)
      : path_(path), line_(line), columns_(columns), cells_(cells) {}
  std::int64_t line() const { return line_; }
  std::string_view text(std::size_t column) const { return cells_[column]; }
  /// NaN for an empty cell, "nan" and a column that the file lacks. Throws for anything else that
  /// is no number.
  double number(std::size_t column) const;
  /// Throws unless the cell is a whole number.
  std::int64_t integer(std::size_t column) const;
  /// Throws std::runtime_error "file:line: column must be ..., got ...".
  [[noreturn]] void refuse(std::size_t column, std::string_view must_be) const;

 private:
  const std::string& path_;
  std::int64_t line_;
  std::span<const std::string_view> columns_, cells_;
};

/// Calls f for every row of a CSV file with a header line. Columns are found by name; those not
/// asked for are passed over. "x or cx" takes either name, the first if both are there. Lines that
/// begin with # are comments. Throws UsageError if the file cannot be read, std::runtime_error that
/// names missing columns, or the file and line of a row with too few cells.
void read_csv(const std::string& path, std::span<const std::string_view> required,
              std::span<const std::string_view> optional,
              const std::function<void(const CsvRow&)>& f);

}  // namespace glint
