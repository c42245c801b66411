// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/inputs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>

namespace glint {
namespace {

namespace fs = std::filesystem;

std::string extension_of(std::string_view path) {
  std::string extension = fs::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

std::optional<InputKind> known_kind(std::string_view path) {
  static constexpr std::pair<std::string_view, InputKind> kKinds[] = {
      {".png", InputKind::image},   {".jpg", InputKind::image},  {".jpeg", InputKind::image},
      {".pgm", InputKind::image},   {".ppm", InputKind::image},  {".pnm", InputKind::image},
      {".bmp", InputKind::image},   {".tif", InputKind::tiff},   {".tiff", InputKind::tiff},
      {".mp4", InputKind::video},   {".avi", InputKind::video},  {".mkv", InputKind::video},
      {".mov", InputKind::video},   {".webm", InputKind::video}, {".m4v", InputKind::video},
      {".fits", InputKind::fits},   {".fit", InputKind::fits},   {".fts", InputKind::fits},
      {".fz", InputKind::fits},     {".npy", InputKind::npy},    {".csv", InputKind::points},
      {".jsonl", InputKind::points}};
  const std::string extension = extension_of(path);
  for (const auto& [name, kind] : kKinds) {
    if (name == extension) return kind;
  }
  return std::nullopt;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Length of the run of digits that starts at `i`.
std::size_t digits_at(std::string_view text, std::size_t i) {
  std::size_t end = i;
  while (end < text.size() && is_digit(text[end])) ++end;
  return end - i;
}

/// A printf pattern with one %d or %0Nd, split at it.
struct Pattern {
  std::string before, after;
};

std::optional<Pattern> as_pattern(const std::string& name) {
  const std::size_t percent = name.find('%');
  if (percent == std::string::npos) return std::nullopt;
  const std::size_t letter = percent + 1 + digits_at(name, percent + 1);
  if (letter >= name.size() || name[letter] != 'd') return std::nullopt;
  return Pattern{name.substr(0, percent), name.substr(letter + 1)};
}

std::optional<std::int64_t> number_in(const std::string& name, const Pattern& pattern) {
  if (name.size() <= pattern.before.size() + pattern.after.size()) return std::nullopt;
  if (!name.starts_with(pattern.before) || !name.ends_with(pattern.after)) return std::nullopt;
  const char* first = name.data() + pattern.before.size();
  const char* last = name.data() + name.size() - pattern.after.size();
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(first, last, number);
  if (error != std::errc{} || end != last || !is_digit(*first)) return std::nullopt;
  return number;
}

std::vector<std::string> expand_pattern(const fs::path& input, const Pattern& pattern,
                                        const Warn& warn) {
  const fs::path folder = input.has_parent_path() ? input.parent_path() : fs::path(".");
  std::vector<std::pair<std::int64_t, std::string>> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto number = number_in(entry.path().filename().string(), pattern);
    if (number) found.emplace_back(*number, entry.path().string());
  }
  if (found.empty()) throw UsageError(input.string() + ": no file matches this pattern");
  std::sort(found.begin(), found.end());
  std::vector<std::string> files;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (i > 0 && found[i].first > found[i - 1].first + 1) {
      warn(fmt::format("{}: the numbers jump from {} to {}; the frames are taken as consecutive",
                       input.string(), found[i - 1].first, found[i].first));
    }
    files.push_back(std::move(found[i].second));
  }
  return files;
}

std::vector<std::string> expand_folder(const fs::path& folder) {
  std::vector<std::string> files;
  std::set<std::string> extensions;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const auto kind = known_kind(entry.path().string());
    if (!entry.is_regular_file() || !kind || kind == InputKind::points) continue;
    files.push_back(entry.path().string());
    extensions.insert(extension_of(files.back()));
  }
  if (files.empty()) {
    throw UsageError(folder.string() + ": no frames in this folder (image, FITS, .npy or video)");
  }
  if (extensions.size() > 1) {
    throw UsageError(
        fmt::format("{}: holds both {} and {} files; name the frames by a pattern, "
                    "such as {}/frame_%04d{}",
                    folder.string(), *extensions.begin(), *extensions.rbegin(), folder.string(),
                    *extensions.begin()));
  }
  std::sort(files.begin(), files.end(), natural_less);
  return files;
}

std::vector<std::string> expand(const std::string& input, const Warn& warn) {
  std::error_code error;
  if (fs::is_directory(input, error)) return expand_folder(input);
  if (fs::exists(input, error)) return {input};
  const fs::path path(input);
  if (const auto pattern = as_pattern(path.filename().string())) {
    return expand_pattern(path, *pattern, warn);
  }
  throw UsageError(input + ": no such file or folder; check the path");
}

}  // namespace

InputKind kind_of(std::string_view path) {
  if (const auto kind = known_kind(path)) return *kind;
  throw UsageError(
      std::string(path) +
      ": unknown kind of file; known are mp4 avi mkv mov webm m4v (video), png jpg pgm "
      "ppm bmp tif (images), fits fit fts fz, npy, csv jsonl (points), and scene:NAME");
}

bool natural_less(std::string_view a, std::string_view b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    const std::size_t da = digits_at(a, i), db = digits_at(b, j);
    if (da == 0 || db == 0) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    std::string_view x = a.substr(i, da), y = b.substr(j, db);
    x.remove_prefix(std::min(x.find_first_not_of('0'), x.size()));
    y.remove_prefix(std::min(y.find_first_not_of('0'), y.size()));
    if (x.size() != y.size()) return x.size() < y.size();
    if (x != y) return x < y;
    i += da, j += db;
  }
  if (i == a.size() && j == b.size()) return a < b;  // "01" and "1": a fixed order
  return i == a.size();
}

std::vector<std::string> expand_inputs(std::span<const std::string> inputs, const Warn& warn) {
  std::vector<std::string> files;
  for (const std::string& input : inputs) {
    for (std::string& file : expand(input, warn)) {
      kind_of(file);
      files.push_back(std::move(file));
    }
  }
  return files;
}

}  // namespace glint
