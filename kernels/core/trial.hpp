// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "glint/kernels/core/device.hpp"

namespace glint {

/// |got - want| <= absolute + relative * |want|. Both zero means equal, NaN and infinity included.
struct Tolerance {
  double absolute = 0, relative = 0;
};

/// One result of a kernel, flattened, with what the fast path may differ from the reference.
struct Output {
  std::string name;
  Tolerance tolerance;
  std::vector<double> values;
};

/// A reproducible problem for one kernel. Parity tests, `glint parity` and `glint bench` share it.
class Trial {
 public:
  virtual ~Trial() = default;
  virtual std::string description() const = 0;      ///< size and mode, e.g. "641x67 u16 5x5"
  virtual void run(const Device& device) = 0;       ///< restores in-place inputs first if it must
  virtual std::vector<Output> outputs() const = 0;  ///< of the last run
};

/// Where two results of the same trial differ first.
struct Mismatch {
  std::string output;
  std::size_t index = 0;
  double want = 0, got = 0;
};

/// Nothing if `got` is inside the tolerances of `want`.
std::vector<Mismatch> compare(const std::vector<Output>& want, const std::vector<Output>& got);

}  // namespace glint
