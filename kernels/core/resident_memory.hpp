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

/// Resizes a resident array, with all that its capacity may hold; values stay, wherever they
/// live.
template <class T>
void resize_resident(const Device& device, AlignedVector<T>& values, Resident& resident,
                     std::size_t size) {
  if (size > values.capacity()) {
    device.fetch(std::span(values));
    resident = {};
    values.reserve(std::max(size, 2 * values.capacity()));
    resident = device.make_resident(std::span(values.data(), values.capacity()));
    device.send(std::span(values));
  }
  values.resize(size);
}

/// An array that is resident on the device (Device::make_resident). Kernels take it as a span; the
/// host reads after fetch() and sends what it writes.
template <class T>
class ResidentArray {
 public:
  explicit ResidentArray(const Device& device) : device_(device) {}
  ResidentArray(ResidentArray&&) noexcept = default;
  ResidentArray& operator=(ResidentArray&& other) noexcept {
    std::swap(device_, other.device_);
    swap(other.values_, other.resident_);
    return *this;
  }
  /// Changes places with a resident array of the same device.
  void swap(AlignedVector<T>& values, Resident& resident) noexcept {
    values_.swap(values);
    std::swap(resident_, resident);
  }

  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  /// New values are undefined.
  void resize(std::size_t size) { resize_resident(device_, values_, resident_, size); }
  std::span<T> values() { return values_; }
  std::span<const T> values() const { return values_; }
  void fetch() const { device_.fetch(values()); }
  void send() const { device_.send(values()); }

  /// Values to bytes and back (engine/state/bytes.hpp).
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
  Resident resident_;
};

/// An image that is resident on the device; one that was read from bytes is the host's until
/// make_resident().
template <class T>
class ResidentImage {
 public:
  ResidentImage() = default;
  ResidentImage(int width, int height, const Device& device)
      : image_(width, height), resident_(device.make_resident(image_.view())) {}
  ResidentImage(ResidentImage&&) noexcept = default;
  ResidentImage& operator=(ResidentImage&& other) noexcept {
    std::swap(image_, other.image_);
    std::swap(resident_, other.resident_);
    return *this;
  }

  int width() const { return image_.width(); }
  int height() const { return image_.height(); }
  ImageView<T> view() { return image_.view(); }
  ImageView<const T> view() const { return image_.view(); }
  Image<T>& image() { return image_; }
  void make_resident(const Device& device) {
    resident_ = device.make_resident(image_.view());
    device.send(image_.view());
  }

  /// Pixels to bytes and back (engine/state/bytes.hpp).
  template <class Writer>
  void put_to(Writer& to) const {
    resident_.fetch(region_of(image_.view()));
    put_bytes(to, image_);
  }
  template <class Reader>
  void take_from(Reader& from) {
    resident_ = {};
    take_bytes(from, image_);
  }

 private:
  Image<T> image_;
  Resident resident_;
};

}  // namespace glint
