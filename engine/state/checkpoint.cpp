// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/state/checkpoint.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "glint/engine/state/fields.hpp"
#include "glint/kernels/core/fnv.hpp"

namespace glint {
namespace {

constexpr std::array<char, 8> kMagic{'G', 'L', 'I', 'N', 'T', 'C', 'K', 'P'};
constexpr std::uint32_t kFormat = 4;  // a change of what a class's fields() names is a new one
constexpr std::size_t kChecksumAt = kMagic.size() + sizeof kFormat;
constexpr std::size_t kLabelAt = kChecksumAt + sizeof(std::uint64_t);

/// FNV-1a by words of eight bytes, the high bits folded in.
std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t sum = kFnvBasis;
  for (std::size_t i = 0; i < bytes.size(); i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min(sizeof word, bytes.size() - i));
    sum = fnv1a_step(sum, word);
    sum ^= sum >> 32;
  }
  return sum ^ bytes.size();
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// The first line that differs, with its section.
std::string first_difference(std::string_view made, std::string_view here) {
  const auto a = lines_of(made), b = lines_of(here);
  std::string section;
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    const std::string_view was = i < a.size() ? a[i] : "nothing",
                           is = i < b.size() ? b[i] : "nothing";
    if (was != is) {
      return "\"" + std::string(was) + "\" then and \"" + std::string(is) + "\" now" + section;
    }
    if (was.starts_with('[')) section = ", in " + std::string(was);
  }
  return "the ends of their lines";
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
  return text;
}

}  // namespace

std::string_view library_version() { return GLINT_VERSION; }

ByteWriter begin_checkpoint(const CheckpointLabel& label) {
  ByteWriter to;
  to.raw(kMagic.data(), kMagic.size());
  put_bytes(to, kFormat);
  put_bytes(to, std::uint64_t{0});
  put_bytes(to, label);
  return to;
}

std::string seal_checkpoint(ByteWriter&& checkpoint) {
  std::string bytes = std::move(checkpoint.bytes());
  const std::uint64_t sum = checksum(std::string_view(bytes).substr(kLabelAt));
  std::memcpy(bytes.data() + kChecksumAt, &sum, sizeof sum);
  return bytes;
}

OpenCheckpoint open_checkpoint(std::string_view bytes) {
  if (bytes.size() < kLabelAt || !std::equal(kMagic.begin(), kMagic.end(), bytes.begin())) {
    throw CheckpointError("these bytes are no checkpoint of Glint");
  }
  OpenCheckpoint open{{}, ByteReader(bytes.substr(kMagic.size()))};
  std::uint32_t format = 0;
  std::uint64_t sum = 0;
  take_bytes(open.state, format), take_bytes(open.state, sum);
  if (format != kFormat) {
    throw CheckpointError("the checkpoint has format " + std::to_string(format) +
                          ", this library reads format " + std::to_string(kFormat) +
                          ": go on with the version of Glint that made it");
  }
  if (sum != checksum(bytes.substr(kLabelAt))) {
    throw CheckpointError("the checkpoint is damaged: its checksum does not match");
  }
  refuse_damaged([&] { take_bytes(open.state, open.label); });
  return open;
}

void require_same(const CheckpointLabel& made, const CheckpointLabel& here) {
  const auto refuse = [](const std::string& what) {
    throw CheckpointError("the checkpoint does not fit: " + what);
  };
  const auto compare = [&](const char* what, const std::string& was, const std::string& is) {
    if (was != is) refuse(std::string(what) + " was " + was + ", and is " + is + " here");
  };
  compare("the library's version", made.version, here.version);
  compare("its maker", made.maker, here.maker);
  compare("the kind of device", made.device, here.device);
  compare("the list of trackers", joined(made.trackers), joined(here.trackers));
  if (made.settings != here.settings) {
    refuse("a setting differs: " + first_difference(made.settings, here.settings));
  }
}

}  // namespace glint
