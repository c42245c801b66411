// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <span>
#include <tuple>
#include <vector>

namespace glint {

/// One owner's part of an array that holds those of all owners. Such an array has the room of the
/// largest scan, which hardly grows in time; one array an owner would have that of each one's
/// largest.
struct IndexRange {
  std::size_t first = 0, count = 0;

  template <class T>
  std::span<const T> of(const std::vector<T>& all) const {
    return std::span(all).subspan(first, count);
  }
  template <class T>
  std::span<T> of(std::vector<T>& all) const {
    return std::span(all).subspan(first, count);
  }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.first, s.count);
  }
};

}  // namespace glint
