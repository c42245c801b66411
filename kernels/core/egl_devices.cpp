// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/egl_devices.hpp"

#include <algorithm>
#include <stdexcept>

#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/egl_hardware.hpp"
#include "glint/kernels/core/gl_context.hpp"

namespace glint {
namespace {

using gl::Candidate;
using gl::Context;
using gl::Egl;

/// What EGL lists, then the platform that needs no device.
std::vector<Candidate> candidates_of(const Egl& egl) {
  std::vector<Candidate> list;
  if (egl.GetPlatformDisplayEXT == nullptr) return list;
  const char* client = egl.QueryString(nullptr, Egl::kExtensions);
  if (gl::has_extension(client, "EGL_EXT_platform_device") && egl.QueryDevicesEXT != nullptr &&
      egl.QueryDeviceStringEXT != nullptr) {
    std::int32_t count = 0;
    egl.QueryDevicesEXT(0, nullptr, &count);
    std::vector<gl::Handle> devices(static_cast<std::size_t>(count));
    egl.QueryDevicesEXT(count, devices.data(), &count);
    for (gl::Handle device : devices) list.push_back({Egl::kPlatformDevice, device});
  }
  if (gl::has_extension(client, "EGL_MESA_platform_surfaceless")) {
    list.push_back({Egl::kPlatformSurfaceless, nullptr});
  }
  return list;
}

/// Opens one device after the other until `wanted` says yes, numbering those that open; the
/// platform that needs no device counts only if nothing else opened. Returns why the last one that
/// failed did.
template <class Wanted>
std::string open_each(const Egl& egl, const Wanted& wanted) {
  std::string failure = "EGL knows no device";
  int number = 0;
  for (const Candidate& candidate : candidates_of(egl)) {
    if (candidate.platform == Egl::kPlatformSurfaceless && number > 0) break;
    std::shared_ptr<Context> context;
    try {
      context = std::make_shared<Context>(egl, candidate, number);
    } catch (const std::runtime_error& e) {
      failure = e.what();
      continue;
    }
    ++number;
    if (wanted(context)) break;
  }
  return failure;
}

std::string none(const std::string& failure) {
  return "no EGL device: " + failure +
         "; install a driver with OpenGL 4.3 (Debian: libegl1 libgl1-mesa-dri) or use --device tbb";
}

}  // namespace

std::string description(const EglDevice& device) {
  const std::string memory = device.memory_bytes == 0
                                 ? std::string()
                                 : std::to_string(device.memory_bytes >> 20) + " MB, ";
  return "egl:" + std::to_string(device.number) + " (" + device.renderer + ", " + device.vendor +
         ", OpenGL " + device.driver + ", " + memory + (device.software ? "software" : "hardware") +
         ")";
}

EglDevices egl_devices() {
  EglDevices found;
  try {
    const Egl egl = gl::open_egl();
    const std::string failure = open_each(egl, [&](const std::shared_ptr<Context>& context) {
      found.devices.push_back(context->device());
      return false;
    });
    if (found.devices.empty()) found.missing = none(failure);
  } catch (const std::runtime_error& e) {
    found.missing = e.what();
  }
  return found;
}

bool lists_hardware() {
  const Egl egl = gl::open_egl();
  return std::ranges::any_of(candidates_of(egl), [&](const Candidate& candidate) {
    return candidate.device != nullptr && !gl::calls_itself_software(egl, candidate.device);
  });
}

bool is_software(const Device& egl) { return egl.context().device().software; }

std::shared_ptr<gl::Context> open_egl_device(int number) {
  const Egl egl = gl::open_egl();
  std::shared_ptr<Context> chosen;
  std::string list;
  const std::string failure = open_each(egl, [&](const std::shared_ptr<Context>& context) {
    const EglDevice& device = context->device();
    list += (list.empty() ? "" : ", ") + description(device);
    const bool any = number == kAnyEglDevice;
    if (any ? chosen == nullptr || !device.software : device.number == number) chosen = context;
    return chosen == context && (!any || !device.software);
  });
  if (list.empty()) throw std::runtime_error(none(failure));
  if (chosen == nullptr) {
    throw std::invalid_argument("device egl:" + std::to_string(number) +
                                " is not here; this machine has " + list);
  }
  return chosen;
}

}  // namespace glint
