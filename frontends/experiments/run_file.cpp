// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/experiments/run_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>

#include "glint/frontends/usage_error.hpp"
#include "glint/kernels/core/fnv.hpp"

namespace glint {
namespace {

/// What stands before a result.
struct RecordHead {
  RunId id;
  std::uint64_t size = 0, digest = 0;
};

std::string header_of(const RunOrigin& origin) {
  std::string header = "glint runs, format 1\n";
  for (const std::string& line : origin) header += line + '\n';
  return header + '\n';
}

/// The first line of `found` that `wanted` does not have at its place, and the one that it has.
std::string difference(const std::string& found, const std::string& wanted) {
  std::istringstream there(found), here(wanted);
  std::string a, b;
  while (std::getline(there, a) && std::getline(here, b) && a == b) {
  }
  return fmt::format("its header has '{}', not '{}'", a.substr(0, 200), b);
}

}  // namespace

RunFile::RunFile(const std::string& path, const RunOrigin& origin)
    : path_(path), file_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (file_ < 0) {
    throw UsageError(path + ": cannot be opened; name a folder that can be written with --keep");
  }
  try {
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
      throw UsageError(path +
                       ": another glint experiment is writing it; wait for it to end, or "
                       "name another folder with --keep");
    }
    open_header(header_of(origin));
  } catch (...) {
    ::close(file_);
    throw;
  }
}

RunFile::~RunFile() { ::close(file_); }

void RunFile::open_header(const std::string& header) {
  const std::uint64_t size = std::filesystem::file_size(path_);
  const std::string found = read(0, std::min<std::uint64_t>(size, header.size()));
  if (!header.starts_with(found)) {
    throw UsageError(path_ + ": holds runs of another program or other settings (" +
                     difference(found, header) +
                     "); name another folder with --keep, or remove the file");
  }
  if (found.size() == header.size()) {
    find_records(header.size());
  } else {
    append(header);
    drop_rest();
  }
}

/// Of a write that was cut short.
void RunFile::drop_rest() {
  if (::ftruncate(file_, static_cast<off_t>(end_)) != 0) {
    throw std::runtime_error(path_ + ": cannot be written");
  }
}

void RunFile::find_records(std::uint64_t from) {
  const std::uint64_t size = std::filesystem::file_size(path_);
  RecordHead head;
  end_ = from;
  while (size - end_ >= sizeof head) {
    std::memcpy(&head, read(end_, sizeof head).data(), sizeof head);
    if (head.size > size - end_ - sizeof head) break;
    const std::uint64_t at = end_ + sizeof head;
    if (fnv1a(read(at, head.size)) != head.digest) break;
    records_[head.id] = {at, head.size};
    end_ = at + head.size;
  }
  drop_rest();
}

std::optional<std::string> RunFile::find(RunId id) {
  const auto found = records_.find(id);
  if (found == records_.end()) return std::nullopt;
  return read(found->second.at, found->second.size);
}

void RunFile::keep(RunId id, const std::string& bytes) {
  const RecordHead head{id, bytes.size(), fnv1a(bytes)};
  std::string record(reinterpret_cast<const char*>(&head), sizeof head);
  append(record + bytes);
  records_[id] = {end_ - bytes.size(), bytes.size()};
}

std::string RunFile::read(std::uint64_t at, std::uint64_t size) const {
  std::string bytes(size, '\0');
  std::size_t done = 0;
  while (done < size) {
    const auto got =
        ::pread(file_, bytes.data() + done, size - done, static_cast<off_t>(at + done));
    if (got <= 0) throw std::runtime_error(path_ + ": cannot be read");
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

/// After the last whole record.
void RunFile::append(const std::string& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const auto put =
        ::pwrite(file_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(end_ + done));
    if (put <= 0) throw std::runtime_error(path_ + ": cannot be written; is the disk full?");
    done += static_cast<std::size_t>(put);
  }
  end_ += bytes.size();
}

std::string run_file_name(const std::string& folder, const std::string& experiment,
                          std::uint64_t seed, const std::string& device) {
  std::string name = fmt::format("{}-seed{}-{}.runs", experiment, seed, device);
  std::ranges::replace(name, ':', '-');
  return (std::filesystem::path(folder) / name).string();
}

std::string program_digest() {
  std::ifstream program("/proc/self/exe", std::ios::binary);
  std::array<char, 65536> part;
  std::uint64_t digest = kFnvBasis;
  while (program.read(part.data(), part.size()), program.gcount() > 0) {
    digest = fnv1a({part.data(), static_cast<std::size_t>(program.gcount())}, digest);
  }
  return fmt::format("{:016x}", digest);
}

}  // namespace glint
