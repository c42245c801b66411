// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "glint/engine/errors.hpp"
#include "glint/kernels/core/frame.hpp"

// State as bytes and back. Classes name what they consist of, once for both ways:
//
//     template <class Self>
//     static auto fields(Self& s) { return std::tie(s.mean_, s.tracks_); }
//
// or fields(OneOf<T> auto&) beside the class. Memory that is only there to be used again is left
// out. A class may have restored(), which is called when its fields were read: it refuses what no
// saved one could hold, above all numbers that something is indexed by, and makes anew what follows
// from the fields. Bytes are for programs of one version: the machine's own layout.
// state/fields.hpp has the templates that write and read them.

namespace glint {

/// T, const or not: what a struct's `fields()` takes.
template <class T, class U>
concept OneOf = std::same_as<std::remove_const_t<T>, U>;

/// Throws BytesError with `otherwise`, "there is no such ...", unless `holds`.
inline void require_bytes(bool holds, const char* otherwise) {
  if (!holds) throw BytesError(otherwise);
}

/// Throws BytesError unless differences of such numbers are numbers.
inline void require_frame_number(std::int64_t frame) {
  require_bytes(frame >= -1 && frame < std::int64_t{1} << 62, "there is no such frame number");
}

class ByteWriter {
 public:
  void raw(const void* from, std::size_t size) {
    bytes_.append(static_cast<const char*>(from), size);
  }
  /// Pixels of a frame that is held more than once are written once.
  void frame(const Frame& frame);
  std::string& bytes() { return bytes_; }

 private:
  std::string bytes_;
  std::vector<Frame> frames_;
};

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : left_(bytes) {}
  /// Throws BytesError where the bytes end early.
  void raw(void* to, std::size_t size) {
    require_bytes(size <= left_.size(), "the bytes end early");
    if (size > 0) std::memcpy(to, left_.data(), size);
    left_.remove_prefix(size);
  }
  /// The number of items that follow, which have `item` bytes each at least: a wrong count must not
  /// fetch memory without end.
  std::size_t count(std::size_t item = 1) {
    std::uint64_t count = 0;
    raw(&count, sizeof count);
    require_bytes(count <= left_.size() / item, "the bytes end early");
    return static_cast<std::size_t>(count);
  }
  Frame frame();
  std::size_t left() const { return left_.size(); }

 private:
  std::string_view left_;
  std::vector<Frame> frames_;
};

/// `kWholeStructs`: structs without fields() are copied byte by byte if they can be; they must not
/// point at anything, nor come from outside.
template <bool kWholeStructs = false, class T>
void put_bytes(ByteWriter& to, const T& value);
/// Throws BytesError. Items of a container are made one by one as they are read, so the memory that
/// wrong bytes can ask for is bounded by their own number.
template <bool kWholeStructs = false, class T>
void take_bytes(ByteReader& from, T& value);

}  // namespace glint
