// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/program_cache.hpp"

#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>

#include "glint/kernels/core/fnv.hpp"

namespace glint::gl {
namespace {

namespace fs = std::filesystem;

constexpr std::array<char, 8> kMagic{'g', 'l', 'i', 'n', 't', 'p', 'r', '1'};
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 28;  // of a file that can be whole

/// What a file begins with; the key and the program follow.
struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint64_t key_bytes = 0, program_bytes = 0, program_hash = 0, format = 0;
};

bool read(std::ifstream& file, char* to, std::uint64_t bytes) {
  return static_cast<bool>(file.read(to, static_cast<std::streamsize>(bytes)));
}

bool write_all(int file, const char* from, std::size_t bytes) {
  while (bytes > 0) {
    const ssize_t written = ::write(file, from, bytes);
    if (written <= 0) return false;
    from += written, bytes -= static_cast<std::size_t>(written);
  }
  return true;
}

std::string contents_of(std::string_view key, const ProgramCache::Program& program) {
  const std::string_view bytes(program.bytes.data(), program.bytes.size());
  const Header header{kMagic, key.size(), bytes.size(), fnv1a(bytes), program.format};
  std::string contents(sizeof header, '\0');
  std::memcpy(contents.data(), &header, sizeof header);
  return contents.append(key).append(bytes);
}

fs::path absolute_from(const char* variable) {
  const char* value = std::getenv(variable);
  const fs::path path(value == nullptr ? "" : value);
  return path.is_absolute() ? path : fs::path();
}

}  // namespace

fs::path ProgramCache::user_folder() {
  if (const fs::path cache = absolute_from("XDG_CACHE_HOME"); !cache.empty())
    return cache / "glint";
  if (const fs::path home = absolute_from("HOME"); !home.empty()) return home / ".cache" / "glint";
  return {};
}

std::string ProgramCache::key_of(std::string_view text) const {
  return (driver_ + '\0').append(text);
}

fs::path ProgramCache::path_of(std::string_view key) const {
  std::array<char, 17> name{};
  std::snprintf(name.data(), name.size(), "%016llx", static_cast<unsigned long long>(fnv1a(key)));
  return folder_ / "programs" / name.data();
}

std::optional<ProgramCache::Program> ProgramCache::find(std::string_view text) const {
  if (folder_.empty()) return std::nullopt;
  const std::string key = key_of(text);
  std::ifstream file(path_of(key), std::ios::binary);
  std::array<char, sizeof(Header)> start{};
  Header header;
  if (!read(file, start.data(), start.size())) return std::nullopt;
  std::memcpy(&header, start.data(), sizeof header);
  if (header.magic != kMagic || header.key_bytes != key.size() ||
      header.program_bytes > kMostBytes) {
    return std::nullopt;
  }
  std::string kept_key(key.size(), '\0');
  Program program{static_cast<unsigned>(header.format), std::vector<char>(header.program_bytes)};
  if (!read(file, kept_key.data(), kept_key.size()) || kept_key != key ||
      !read(file, program.bytes.data(), program.bytes.size()) ||
      fnv1a({program.bytes.data(), program.bytes.size()}) != header.program_hash) {
    return std::nullopt;
  }
  return program;
}

void ProgramCache::keep(std::string_view text, const Program& program) const {
  if (folder_.empty()) return;
  const std::string key = key_of(text);
  const fs::path path = path_of(key);
  std::error_code failed;
  fs::create_directories(path.parent_path(), failed);
  // A file of its own, renamed when it is whole: nobody reads half of it.
  std::string draft = path.string() + ".XXXXXX";
  const int file = ::mkstemp(draft.data());
  if (file < 0) return;
  const std::string contents = contents_of(key, program);
  const bool whole = write_all(file, contents.data(), contents.size());
  if (::close(file) == 0 && whole) fs::rename(draft, path, failed);
  fs::remove(draft, failed);
}

}  // namespace glint::gl
