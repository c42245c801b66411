// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <concepts>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "glint/engine/state/bytes.hpp"
#include "glint/kernels/core/frame.hpp"

// How put_bytes() and take_bytes() write and read each kind of value: numbers, strings, containers,
// Eigen's matrices, images and frames, and classes that name their fields. For .cpp files: it takes
// Eigen along.

namespace glint {

/// Writes and reads itself.
template <class T>
concept OwnBytes = requires(const T& saved, T& loaded, ByteWriter& to, ByteReader& from) {
  saved.put_to(to);
  loaded.take_from(from);
};

namespace detail {
template <class T>
concept Number = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <class T>
concept Matrix = requires(T& matrix) {
  typename T::PlainObject;
  T::MaxColsAtCompileTime;
  matrix.data();
};
/// Numbers in a row, copied in one piece.
template <class T>
concept NumberRow = Number<typename T::value_type> && !std::same_as<typename T::value_type, bool> &&
                    requires(T & row) {
  row.data();
  row.resize(std::size_t{});
};
template <class T>
concept MemberFields = requires(T& value) {
  std::remove_const_t<T>::fields(value);
};
template <class T>
concept FreeFields = requires(T& value) {
  fields(value);
};

template <class T>
auto fields_of(T& value) {
  if constexpr (MemberFields<T>) {
    return std::remove_const_t<T>::fields(value);
  } else {
    return fields(value);
  }
}

template <class T>
inline constexpr bool kIsMap = false;
template <class K, class V>
inline constexpr bool kIsMap<std::map<K, V>> = true;
template <class T>
inline constexpr bool kIsVariant = false;
template <class... A>
inline constexpr bool kIsVariant<std::variant<A...>> = true;
template <class T>
inline constexpr bool kIsArray = false;
template <class T, std::size_t N>
inline constexpr bool kIsArray<std::array<T, N>> = true;
template <class T>
inline constexpr bool kIsImage = false;
template <class T>
inline constexpr bool kIsImage<Image<T>> = true;

template <bool kWholeStructs, std::size_t I = 0, class... A>
void take_alternative(ByteReader& from, std::variant<A...>& value, std::size_t index) {
  if constexpr (I < sizeof...(A)) {
    if (index == I) return take_bytes<kWholeStructs>(from, value.template emplace<I>());
    take_alternative<kWholeStructs, I + 1>(from, value, index);
  } else {
    throw BytesError("there is no such alternative");
  }
}

void take_size(ByteReader& from, std::size_t pixel, int& width, int& height);
template <class T>
void put_image(ByteWriter& to, ImageView<const T> image) {
  put_bytes(to, image.width), put_bytes(to, image.height);
  const std::size_t row = static_cast<std::size_t>(image.width) * sizeof(T);
  for (int y = 0; y < image.height; ++y) to.raw(image.row(y), row);
}

template <class T>
Image<T> take_image(ByteReader& from) {
  int width = 0, height = 0;
  take_size(from, sizeof(T), width, height);
  if (width == 0) return {};
  Image<T> image(width, height);
  const ImageView<T> view = image.view();
  const std::size_t row = static_cast<std::size_t>(width) * sizeof(T);
  for (int y = 0; y < height; ++y) from.raw(view.row(y), row);
  return image;
}

}  // namespace detail

template <bool kWholeStructs, class T>
void put_bytes(ByteWriter& to, const T& value) {
  const auto put = [&to](const auto& part) { put_bytes<kWholeStructs>(to, part); };
  if constexpr (detail::Number<T>) {  // NOLINT(bugprone-branch-clone): their order counts
    to.raw(&value, sizeof value);
  } else if constexpr (OwnBytes<T>) {
    value.put_to(to);
  } else if constexpr (detail::MemberFields<const T> || detail::FreeFields<const T>) {
    std::apply([&](const auto&... field) { (put(field), ...); }, detail::fields_of(value));
  } else if constexpr (kWholeStructs && std::is_trivially_copyable_v<T>) {
    to.raw(&value, sizeof value);
  } else if constexpr (std::same_as<T, Frame>) {
    to.frame(value);
  } else if constexpr (detail::kIsImage<T>) {
    detail::put_image(to, value.view());
  } else if constexpr (detail::Matrix<T>) {
    if constexpr (T::SizeAtCompileTime == Eigen::Dynamic) put(value.rows()), put(value.cols());
    to.raw(value.data(), static_cast<std::size_t>(value.size()) * sizeof(typename T::Scalar));
  } else if constexpr (detail::kIsVariant<T>) {
    put(static_cast<std::uint8_t>(value.index()));
    std::visit(put, value);
  } else if constexpr (detail::kIsArray<T>) {
    for (const auto& item : value) put(item);
  } else {
    put(static_cast<std::uint64_t>(value.size()));
    if constexpr (detail::NumberRow<T>) {
      to.raw(value.data(), value.size() * sizeof(typename T::value_type));
    } else if constexpr (detail::kIsMap<T>) {
      for (const auto& [key, mapped] : value) put(key), put(mapped);
    } else {
      for (const auto& item : value) put(item);
    }
  }
}

namespace detail {
template <bool kWholeStructs, class T>
void take_container(ByteReader& from, T& value) {
  if constexpr (NumberRow<T>) {
    using Item = typename T::value_type;
    value.resize(from.count(sizeof(Item)));
    from.raw(value.data(), value.size() * sizeof(Item));
  } else if constexpr (kIsMap<T>) {
    value.clear();
    for (std::size_t left = from.count(); left > 0; --left) {
      typename T::key_type key{};
      take_bytes<kWholeStructs>(from, key);
      take_bytes<kWholeStructs>(from, value[std::move(key)]);
    }
  } else {
    value = T{};
    for (std::size_t left = from.count(); left > 0; --left) {
      std::remove_cvref_t<decltype(*value.begin())> item{};
      take_bytes<kWholeStructs>(from, item);
      value.push_back(std::move(item));
    }
  }
}

template <class T>
void take_matrix(ByteReader& from, T& value) {
  if constexpr (T::SizeAtCompileTime == Eigen::Dynamic) {
    Eigen::Index rows = 0, cols = 0;
    take_bytes(from, rows), take_bytes(from, cols);
    require_bytes(rows >= 0 && cols >= 0 && rows <= T::MaxRowsAtCompileTime &&
                      cols <= T::MaxColsAtCompileTime,
                  "a matrix is too large");
    value.resize(rows, cols);
  }
  from.raw(value.data(), static_cast<std::size_t>(value.size()) * sizeof(typename T::Scalar));
}

}  // namespace detail

template <bool kWholeStructs, class T>
void take_bytes(ByteReader& from, T& value) {
  const auto take = [&from](auto& part) { take_bytes<kWholeStructs>(from, part); };
  if constexpr (std::same_as<T, bool>) {
    std::uint8_t byte = 0;
    take(byte);
    require_bytes(byte <= 1, "a truth value is neither true nor false");
    value = byte == 1;
  } else if constexpr (detail::Number<T>) {
    from.raw(&value, sizeof value);
  } else if constexpr (OwnBytes<T>) {
    value.take_from(from);
  } else if constexpr (detail::MemberFields<T> || detail::FreeFields<T>) {
    std::apply([&](auto&... field) { (take(field), ...); }, detail::fields_of(value));
    if constexpr (requires { value.restored(); }) value.restored();
  } else if constexpr (kWholeStructs && std::is_trivially_copyable_v<T>) {
    static_assert(!std::is_pointer_v<T>);
    from.raw(&value, sizeof value);
  } else if constexpr (std::same_as<T, Frame>) {
    value = from.frame();
  } else if constexpr (detail::kIsImage<T>) {
    value = detail::take_image<std::remove_cvref_t<decltype(*value.view().data)>>(from);
  } else if constexpr (detail::Matrix<T>) {
    detail::take_matrix(from, value);
  } else if constexpr (detail::kIsVariant<T>) {
    std::uint8_t index = 0;
    take(index);
    detail::take_alternative<kWholeStructs>(from, value, index);
  } else if constexpr (detail::kIsArray<T>) {
    for (auto& item : value) take(item);
  } else {
    detail::take_container<kWholeStructs>(from, value);
  }
}

}  // namespace glint
