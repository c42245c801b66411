// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "glint/kernels/core/device.hpp"

namespace glint::test {

/// Whether the user says that this machine has no EGL device. Nothing else lets a test off.
inline bool egl_is_waived() {
  const char* set = std::getenv("GLINT_NO_EGL");
  return set != nullptr && std::string_view(set) == "1";
}

/// Nothing, after a failure that says what to do, where there is no egl device.
inline std::optional<Device> egl_device() {
  try {
    return Device::egl();
  } catch (const std::runtime_error& e) {
    ADD_FAILURE() << e.what() << "\nscripts/setup installs one that needs no hardware; "
                  << "GLINT_NO_EGL=1 leaves these tests out";
    return std::nullopt;
  }
}

}  // namespace glint::test

/// Defines `device`, an egl device, in a test that cannot do without.
#define GLINT_NEEDS_EGL(device)                                                                 \
  if (glint::test::egl_is_waived()) GTEST_SKIP() << "NOT TESTED ON EGL: GLINT_NO_EGL=1 is set"; \
  const auto device##_or_nothing = glint::test::egl_device();                                   \
  if (!device##_or_nothing) return;                                                             \
  /* a name cannot stand in parentheses: NOLINTNEXTLINE(bugprone-macro-parentheses) */          \
  [[maybe_unused]] const glint::Device& device = *device##_or_nothing
