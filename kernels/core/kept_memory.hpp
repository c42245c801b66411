// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "glint/kernels/core/aligned.hpp"
#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/frame.hpp"

namespace glint {

/// Resizes an array that is kept, with all that its capacity may hold; values stay, wherever they
/// live.
template <class T>
void resize_kept(const Device& device, AlignedVector<T>& values, Kept& kept, std::size_t size) {
  if (size > values.capacity()) {
    device.fetch(std::span(values));
    kept = {};
    values.reserve(std::max(size, 2 * values.capacity()));
    kept = device.keep(std::span(values.data(), values.capacity()));
    device.send(std::span(values));
  }
  values.resize(size);
}

/// An array that is kept. Kernels take it as a span; the host reads after fetch() and sends what it
/// writes.
template <class T>
class KeptArray {
 public:
  explicit KeptArray(const Device& device) : device_(device) {}
  KeptArray(KeptArray&&) noexcept = default;
  KeptArray& operator=(KeptArray&& other) noexcept {
    std::swap(device_, other.device_);
    swap(other.values_, other.kept_);
    return *this;
  }
  /// Changes places with an array that is kept by the same device.
  void swap(AlignedVector<T>& values, Kept& kept) noexcept {
    values_.swap(values);
    std::swap(kept_, kept);
  }

  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  /// New values are undefined.
  void resize(std::size_t size) { resize_kept(device_, values_, kept_, size); }
  std::span<T> values() { return values_; }
  std::span<const T> values() const { return values_; }
  void fetch() const { device_.fetch(values()); }
  void send() const { device_.send(values()); }

  /// Values to bytes and back (engine/bytes.hpp).
  template <class Writer>
  void put_to(Writer& to) const {
    fetch();
    put_bytes(to, values_);
  }
  template <class Reader>
  void take_from(Reader& from) {
    AlignedVector<T> values;
    take_bytes(from, values);
    resize(values.size());
    std::ranges::copy(values, values_.begin());
    send();
  }

 private:
  Device device_;
  AlignedVector<T> values_;
  Kept kept_;
};

/// An image that is kept, but for one that was read from bytes: until keep() it is the host's.
template <class T>
class KeptImage {
 public:
  KeptImage() = default;
  KeptImage(int width, int height, const Device& device)
      : image_(width, height), kept_(device.keep(image_.view())) {}
  KeptImage(KeptImage&&) noexcept = default;
  KeptImage& operator=(KeptImage&& other) noexcept {
    std::swap(image_, other.image_);
    std::swap(kept_, other.kept_);
    return *this;
  }

  int width() const { return image_.width(); }
  int height() const { return image_.height(); }
  ImageView<T> view() { return image_.view(); }
  ImageView<const T> view() const { return image_.view(); }
  Image<T>& image() { return image_; }
  void keep(const Device& device) {
    kept_ = device.keep(image_.view());
    device.send(image_.view());
  }

  /// Pixels to bytes and back (engine/bytes.hpp).
  template <class Writer>
  void put_to(Writer& to) const {
    kept_.fetch(region_of(image_.view()));
    put_bytes(to, image_);
  }
  template <class Reader>
  void take_from(Reader& from) {
    kept_ = {};
    take_bytes(from, image_);
  }

 private:
  Image<T> image_;
  Kept kept_;
};

}  // namespace glint
