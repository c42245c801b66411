// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace glint {

class Device;

/// Whether EGL lists a device that does not call itself a rasteriser in software. Opens none of
/// them. Throws std::runtime_error with the remedy where there is no EGL.
bool lists_hardware();
/// Whether a rasteriser on the processor stands in for an egl device.
bool is_software(const Device& egl);

}  // namespace glint
