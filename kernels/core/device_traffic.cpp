// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/device_traffic.hpp"

#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"

namespace glint {

void time_traffic(const Device& egl, bool timed) {
  egl.context().run([&](gl::Queue& queue) { queue.time_traffic(timed); });
}

DeviceTraffic traffic_of(const Device& egl) {
  DeviceTraffic traffic;
  egl.context().run([&](gl::Queue& queue) { traffic = queue.traffic(); });
  return traffic;
}

double copy_seconds(const Device& egl, std::size_t bytes, int times) {
  double least = 0;
  egl.context().run([&](gl::Queue& queue) { least = queue.copy_seconds(bytes, times); });
  return least;
}

std::size_t max_buffer_bytes(const Device& egl) {
  std::size_t most = 0;
  egl.context().run([&](gl::Queue& queue) { most = queue.max_bytes(); });
  return most;
}

}  // namespace glint
