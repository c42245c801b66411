// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <memory>
#include <utility>

#include "glint/kernels/core/region.hpp"

namespace glint {

namespace gl {
class Context;
}

/// Holds a piece of the host's memory on an egl device (Device::make_resident) for as long as it
/// lives: it must go before the memory does.
class Resident {
 public:
  Resident() = default;
  Resident(std::shared_ptr<gl::Context> context, const std::byte* memory)
      : context_(std::move(context)), memory_(memory) {}
  Resident(Resident&& other) noexcept
      : context_(std::move(other.context_)), memory_(std::exchange(other.memory_, nullptr)) {}
  Resident& operator=(Resident&& other) noexcept {
    std::swap(context_, other.context_), std::swap(memory_, other.memory_);
    return *this;
  }
  Resident(const Resident&) = delete;
  Resident& operator=(const Resident&) = delete;
  ~Resident();
  /// Brings the host's bytes of the region, a part of what is held, up to date.
  void fetch(const Region& region) const;

 private:
  std::shared_ptr<gl::Context> context_;
  const std::byte* memory_ = nullptr;
};

}  // namespace glint
