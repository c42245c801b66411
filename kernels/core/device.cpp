// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/device.hpp"

#include <stdexcept>

namespace glint {

std::string_view name(DeviceKind kind) { return kind == DeviceKind::serial ? "serial" : "tbb"; }

Device Device::named(std::string_view kind, int threads) {
  if (kind == "serial") return serial();
  if (kind == "tbb" || kind == "auto") return tbb(threads);
  throw std::invalid_argument("device '" + std::string(kind) +
                              "' is not known: use auto, serial or tbb");
}

std::string Device::description() const {
  if (kind_ == DeviceKind::serial) return "serial (double precision reference, 1 thread)";
  return "tbb (" + std::to_string(workers_->threads()) + " threads, " +
         std::string(glint::name(workers_->isa())) + ")";
}

}  // namespace glint
