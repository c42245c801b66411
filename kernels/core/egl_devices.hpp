// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace glint {

namespace gl {
class Context;
}

/// What a driver says of a device that runs OpenGL compute without a display.
struct EglDevice {
  int number = 0;  ///< N of --device egl:N
  std::string vendor, renderer;
  std::string driver;              ///< its version of OpenGL and its own
  std::uint64_t memory_bytes = 0;  ///< 0 = the driver does not tell
  bool software = false;           ///< a rasteriser on the processor: right, but slow
};

/// One line: number, renderer, vendor, driver, memory, hardware or software.
std::string description(const EglDevice& device);

/// The devices of this machine, or why there is none.
struct EglDevices {
  std::vector<EglDevice> devices;
  std::string missing;  ///< why there are none, with the remedy; else empty
};
EglDevices egl_devices();

inline constexpr int kAnyEglDevice = -1;

/// Opens device N, or with kAnyEglDevice the first that is hardware, else the first. Throws
/// std::runtime_error, with the remedy, if there is none, and std::invalid_argument that lists what
/// there is for another number.
std::shared_ptr<gl::Context> open_egl_device(int number);

}  // namespace glint
