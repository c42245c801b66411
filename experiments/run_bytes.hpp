// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <utility>

#include "glint/engine/state/fields.hpp"

namespace glint {

// A run's result as bytes, for programs of one build: structs without fields() are copied whole.

template <class T>
std::string run_bytes(const T& result) {
  ByteWriter to;
  put_bytes<true>(to, result);
  return std::move(to.bytes());
}
/// Throws BytesError if `bytes` are not those of a T.
template <class T>
T run_of_bytes(std::string_view bytes) {
  ByteReader from(bytes);
  T result{};
  take_bytes<true>(from, result);
  require_bytes(from.left() == 0, "the record of a run is too long");
  return result;
}

}  // namespace glint
