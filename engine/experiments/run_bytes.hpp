// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <concepts>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

namespace glint {

/// T, const or not: what a struct's `fields()` takes.
template <class T, class U>
concept OneOf = std::same_as<std::remove_const_t<T>, U>;

/// Appends the bytes of a run's result: values that can be copied byte by byte (which must not
/// point at anything), strings, vectors and maps of such, and structs for which `fields()` gives a
/// tuple of references. For programs of one build: the machine's own layout.
template <class T>
void append_bytes(const T& value, std::string& bytes);

/// Takes values off the front of `bytes`, as append_bytes() wrote them. Throws std::runtime_error
/// where they end early.
template <class T>
void take_bytes(std::string_view& bytes, T& value);

namespace detail {

template <class T>
inline constexpr bool kIsMap = false;
template <class K, class V>
inline constexpr bool kIsMap<std::map<K, V>> = true;

inline void take_raw(std::string_view& bytes, void* to, std::size_t size) {
  if (bytes.size() < size) throw std::runtime_error("the record of a run ends early");
  std::memcpy(to, bytes.data(), size);
  bytes.remove_prefix(size);
}

inline std::size_t take_count(std::string_view& bytes) {
  std::uint64_t count = 0;
  take_raw(bytes, &count, sizeof count);
  // Every item has a byte at least: a wrong count must not fetch memory without end.
  if (count > bytes.size()) throw std::runtime_error("the record of a run ends early");
  return static_cast<std::size_t>(count);
}

}  // namespace detail

template <class T>
void append_bytes(const T& value, std::string& bytes) {
  if constexpr (std::is_trivially_copyable_v<T>) {
    static_assert(!std::is_pointer_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  } else if constexpr (requires { fields(value); }) {
    std::apply([&](const auto&... field) { (append_bytes(field, bytes), ...); }, fields(value));
  } else {
    append_bytes(static_cast<std::uint64_t>(value.size()), bytes);
    for (const auto& item : value) {
      if constexpr (detail::kIsMap<T>) {
        append_bytes(item.first, bytes), append_bytes(item.second, bytes);
      } else {
        append_bytes(item, bytes);
      }
    }
  }
}

template <class T>
void take_bytes(std::string_view& bytes, T& value) {
  if constexpr (std::is_trivially_copyable_v<T>) {
    detail::take_raw(bytes, &value, sizeof value);
  } else if constexpr (requires { fields(value); }) {
    std::apply([&](auto&... field) { (take_bytes(bytes, field), ...); }, fields(value));
  } else if constexpr (detail::kIsMap<T>) {
    for (std::size_t left = detail::take_count(bytes); left > 0; --left) {
      typename T::key_type key{};
      take_bytes(bytes, key);
      take_bytes(bytes, value[key]);
    }
  } else {
    value.resize(detail::take_count(bytes));
    for (auto& item : value) take_bytes(bytes, item);
  }
}

/// Both ways for a whole result.
template <class T>
std::string run_bytes(const T& result) {
  std::string bytes;
  append_bytes(result, bytes);
  return bytes;
}
/// Throws std::runtime_error if `bytes` are not those of a T.
template <class T>
T run_of_bytes(std::string_view bytes) {
  T result{};
  take_bytes(bytes, result);
  if (!bytes.empty()) throw std::runtime_error("the record of a run is too long");
  return result;
}

}  // namespace glint
