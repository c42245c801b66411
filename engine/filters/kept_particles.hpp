// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "glint/engine/bytes.hpp"
#include "glint/kernels/core/kept_memory.hpp"
#include "glint/kernels/core/particles.hpp"

namespace glint {

/// Particles that are kept on the device: kernels move and weigh them there. The host reads after
/// fetch() and sends what it writes.
class KeptParticles {
 public:
  explicit KeptParticles(const Device& device) : device_(device) {}
  KeptParticles(KeptParticles&&) noexcept = default;
  KeptParticles& operator=(KeptParticles&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(arrays_, other.arrays_);
    std::swap(kept_, other.kept_);
    return *this;
  }

  std::size_t size() const { return arrays_.size(); }
  Particles& arrays() { return arrays_; }
  const Particles& arrays() const { return arrays_; }

  /// New particles are undefined.
  void resize(std::size_t size) {
    each([&](auto& values, Kept& kept) { resize_kept(device_, values, kept, size); });
  }
  void fetch() {
    each([&](auto& values, Kept&) { device_.fetch(std::span(values)); });
  }

  void put_to(ByteWriter& to) const {
    // What is fetched are bytes that count for nothing as yet.
    const_cast<KeptParticles&>(*this).fetch();
    put_bytes(to, arrays_);
  }
  void take_from(ByteReader& from) {
    Particles read;
    take_bytes(from, read);
    read.for_each_array([&](const auto& values) {
      require_bytes(values.size() == read.size(), "arrays of particles do not fit each other");
    });
    resize(read.size());  // then this copies to where the arrays are
    arrays_ = read;
    each([&](auto& values, Kept&) { device_.send(std::span(values)); });
  }
  void swap_weight(KeptArray<float>& other) noexcept { other.swap(arrays_.weight, kept_[kWeight]); }

 private:
  /// Calls f(array, its keeping) for all arrays.
  template <class F>
  void each(const F& f) {
    auto kept = kept_.begin();
    arrays_.for_each_array([&](auto& values) { f(values, *kept++); });
  }

  static constexpr std::size_t kWeight = 7;  // its place in for_each_array()

  Device device_;
  Particles arrays_;
  std::array<Kept, 10> kept_;
};

}  // namespace glint
