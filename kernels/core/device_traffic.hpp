// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>

/// What an egl device's time goes to, for benchmarks: all its parameters are egl devices.
namespace glint {

class Device;

/// Wall clock [s] and bytes of what a device did while it was timed.
struct DeviceTraffic {
  double upload = 0, compute = 0, read_back = 0;
  std::size_t uploaded = 0, read = 0;
};

/// Starts to keep the times of the device's work, from nothing, or stops. While they are kept every
/// piece of work is waited for, so that each has its own time and none overlaps another.
void time_traffic(const Device& egl, bool timed);
DeviceTraffic traffic_of(const Device& egl);
/// Time [s] in which the device copies `bytes` from one of its buffers to another: the least of
/// `times`. At most max_buffer_bytes().
double copy_seconds(const Device& egl, std::size_t bytes, int times);
/// Largest buffer that the device takes.
std::size_t max_buffer_bytes(const Device& egl);

}  // namespace glint
