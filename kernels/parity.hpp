// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "glint/kernels/core/device.hpp"
#include "glint/kernels/trials.hpp"

namespace glint {

/// How one trial of a kernel came out on one device.
struct ParityRow {
  std::string kernel, trial, device;
  /// Largest |got - want| over its tolerance; <= 1 passes, infinity if a value or its place differs
  /// beyond measure (NaN, another length, no tolerance at all).
  double worst = 0;
  std::optional<Mismatch> outside = std::nullopt;  ///< first value outside the tolerance of serial
  std::optional<Mismatch> other_bits =
      std::nullopt;  ///< first value that is not bit for bit the first device's

  bool ok() const { return !outside && !other_bits; }
};

/// One sentence a row: device, verdict, and the first differing index if there is one.
std::string description(const ParityRow& row);

/// Runs every trial on the serial device and on each of `devices`: all must be inside the trial's
/// tolerance of serial, and bitwise equal to the first of them. Rows carry the kernel's name.
std::vector<ParityRow> check_parity(std::string_view kernel,
                                    std::span<const std::unique_ptr<Trial>> trials,
                                    std::span<const Device> devices);
/// All trials of a kernel.
std::vector<ParityRow> check_parity(const KernelEntry& kernel, std::span<const Device> devices);

/// The devices of the same kind that must agree with `device` bit for bit. tbb: 1, 2, 3 and 8
/// threads on every instruction set that runs here; eight only run at once while the caller holds a
/// tbb::global_control that allows them. serial: the same twice. egl: the same twice, and once with
/// buffers so small that problems are cut.
std::vector<Device> parity_devices(const Device& device);

}  // namespace glint
