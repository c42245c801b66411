// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <type_traits>

namespace glint {

/// At most `Capacity` values in a row, held in place: nothing allocates, and copies cost what is in
/// the list, not what it has room for.
template <class T, std::size_t Capacity>
class ShortList {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  using value_type = T;

  ShortList() : none_() {}
  /// Throws std::length_error beyond Capacity, like push_back() and resize().
  ShortList(std::initializer_list<T> values) : none_() {
    for (const T& value : values) push_back(value);
  }
  ShortList(const ShortList& other) noexcept : none_() { copy(other); }
  ShortList& operator=(const ShortList& other) noexcept {
    if (this != &other) copy(other);
    return *this;
  }
  ~ShortList() = default;

  void push_back(const T& value) {
    if (size_ == Capacity) throw std::length_error("the short list is full");
    std::construct_at(&values_[size_++], value);
  }
  /// New values are T{}.
  void resize(std::size_t size) {
    while (size_ < size) push_back(T{});
    size_ = size;
  }
  void clear() { size_ = 0; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](std::size_t i) { return values_[i]; }
  const T& operator[](std::size_t i) const { return values_[i]; }
  T* begin() { return values_; }
  T* end() { return values_ + size_; }
  const T* begin() const { return values_; }
  const T* end() const { return values_ + size_; }

 private:
  void copy(const ShortList& other) noexcept {
    size_ = other.size_;
    for (std::size_t i = 0; i < size_; ++i) std::construct_at(&values_[i], other.values_[i]);
  }

  std::size_t size_ = 0;
  union {
    char none_;
    T values_[Capacity];  // of which the first size_ live
  };
};

}  // namespace glint
