// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "glint/kernels/core/device.hpp"

namespace glint {

/// An egl device of hardware, or why there is none.
struct HardwareFound {
  std::optional<Device> device;
  std::string none;
};

/// What `auto` asks of a machine; tests put another in its place.
struct AutoProbe {
  /// Throws where there is a device that does not open.
  std::function<HardwareFound(int threads)> hardware;
  /// Time [s] that a device takes for the calibration's kernels; throws what they throw.
  std::function<double(const Device&)> seconds;
};
AutoProbe this_machine();

struct AutoChoice {
  Device device;
  std::string why;      ///< one line
  bool failed = false;  ///< there is hardware, but it does not work: worth a warning
};
/// tbb, unless the machine has a GPU of hardware that takes less than kAutoShare of tbb's time for
/// the same kernels, with what travels both ways. `threads` as Device::tbb() takes them.
AutoChoice choose_device(int threads, const AutoProbe& probe = this_machine());

/// A GPU that is as fast as the processor would only make runs differ from day to day.
inline constexpr double kAutoShare = .8;

}  // namespace glint
