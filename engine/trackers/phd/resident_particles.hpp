// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "glint/engine/state/bytes.hpp"
#include "glint/kernels/core/particles.hpp"
#include "glint/kernels/core/resident_memory.hpp"
#include "glint/kernels/resample/resample.hpp"

namespace glint {

/// Particles in the device's memory, where kernels move and weigh them. The host reads them after
/// fetch() and sends what it writes.
class ResidentParticles {
 public:
  explicit ResidentParticles(const Device& device) : device_(device) {}
  ResidentParticles(ResidentParticles&&) noexcept = default;
  ResidentParticles& operator=(ResidentParticles&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(arrays_, other.arrays_);
    std::swap(residents_, other.residents_);
    return *this;
  }

  std::size_t size() const { return arrays_.size(); }
  Particles& arrays() { return arrays_; }
  const Particles& arrays() const { return arrays_; }

  /// New particles are undefined.
  void resize(std::size_t size) {
    each([&](auto& values, Resident& resident) {
      resize_resident(device_, values, resident, size);
    });
  }
  /// Copies the particles from the device to the host, whose values are out of date before.
  void fetch() const {
    arrays_.for_each_array([&](const auto& values) { device_.fetch(std::span(values)); });
  }

  void put_to(ByteWriter& to) const;
  void take_from(ByteReader& from);
  void swap_weight(ResidentArray<float>& other) noexcept {
    other.swap(arrays_.weight, residents_[kWeight]);
  }

 private:
  /// Calls f(array, its Resident) for all arrays.
  template <class F>
  void each(const F& f) {
    auto resident = residents_.begin();
    arrays_.for_each_array([&](auto& values) { f(values, *resident++); });
  }

  static constexpr std::size_t kWeight = 7;  // its place in for_each_array()

  Device device_;
  Particles arrays_;
  std::array<Resident, 10> residents_;
};

/// All arrays of `from` but the weight, from particle `first` on, as they move to `to` in
/// resampling, from particle `target` on.
inline std::array<MovedArray, 9> moved_particles(const Particles& from, std::size_t first,
                                                 Particles& to, std::size_t target) {
  return {MovedArray{from.x.data() + first, to.x.data() + target},
          MovedArray{from.y.data() + first, to.y.data() + target},
          MovedArray{from.vx.data() + first, to.vx.data() + target},
          MovedArray{from.vy.data() + first, to.vy.data() + target},
          MovedArray{from.ax.data() + first, to.ax.data() + target},
          MovedArray{from.ay.data() + first, to.ay.data() + target},
          MovedArray{from.intensity.data() + first, to.intensity.data() + target},
          MovedArray{from.mode.data() + first, to.mode.data() + target},
          MovedArray{from.label.data() + first, to.label.data() + target}};
}

}  // namespace glint
