// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/parity.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>

#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"

namespace glint {
namespace {

double error_over_tolerance(double want, double got, Tolerance t) {
  if (want == got || (std::isnan(want) && std::isnan(got))) return 0;
  const double ratio = std::abs(got - want) / (t.absolute + t.relative * std::abs(want));
  return std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio;
}

double worst_error(const std::vector<Output>& want, const std::vector<Output>& got) {
  double worst = 0;
  if (want.size() != got.size()) return std::numeric_limits<double>::infinity();
  for (std::size_t o = 0; o < want.size(); ++o) {
    const auto &a = want[o].values, &b = got[o].values;
    if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < a.size(); ++i) {
      worst = std::max(worst, error_over_tolerance(a[i], b[i], want[o].tolerance));
    }
  }
  return worst;
}

std::optional<Mismatch> first_other_bits(const std::vector<Output>& want,
                                         const std::vector<Output>& got) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  const auto value = [](const std::vector<double>& v, std::size_t i) {
    return i < v.size() ? v[i] : std::numeric_limits<double>::quiet_NaN();
  };
  for (std::size_t o = 0; o < std::min(want.size(), got.size()); ++o) {
    const auto &a = want[o].values, &b = got[o].values;
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
      if (i < a.size() && i < b.size() && bits(a[i]) == bits(b[i])) continue;
      return Mismatch{want[o].name, i, value(a, i), value(b, i)};
    }
  }
  return std::nullopt;
}

std::string sentence(const char* what, const Mismatch& m) {
  std::ostringstream text;
  text.precision(17);
  text << "; " << what << " first in " << m.output << '[' << m.index << "]: want " << m.want
       << ", got " << m.got;
  return text.str();
}

/// A context of its own on the same device.
Device with_small_buffers(const Device& device) {
  constexpr std::size_t kBytes = std::size_t{540} << 10;
  Device small = Device::egl(device.context().device().number);
  small.context().run([](gl::Queue& queue) { queue.limit(kBytes); });
  return small;
}

}  // namespace

std::string description(const ParityRow& row) {
  std::string text = row.kernel + " (" + row.trial + ") on " + row.device + ": ";
  text += row.ok() ? "ok" : "FAILED";
  if (row.outside) text += sentence("outside the tolerance of serial", *row.outside);
  if (row.other_bits) text += sentence("other bits than the first device", *row.other_bits);
  return text;
}

std::vector<ParityRow> check_parity(std::string_view kernel,
                                    std::span<const std::unique_ptr<Trial>> trials,
                                    std::span<const Device> devices) {
  std::vector<ParityRow> rows;
  for (const auto& trial : trials) {
    trial->run(Device::serial());
    const std::vector<Output> reference = trial->outputs();
    std::vector<Output> first;
    for (const Device& device : devices) {
      trial->run(device);
      std::vector<Output> got = trial->outputs();
      ParityRow row{std::string(kernel), trial->description(), device.description()};
      row.worst = worst_error(reference, got);
      const std::vector<Mismatch> found = compare(reference, got);
      if (!found.empty()) row.outside = found.front();
      if (first.empty()) {
        first = std::move(got);
      } else {
        row.other_bits = first_other_bits(first, got);
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::vector<ParityRow> check_parity(const KernelEntry& kernel, std::span<const Device> devices) {
  return check_parity(kernel.name, trials_of(kernel), devices);
}

std::vector<Device> parity_devices(const Device& device) {
  if (device.kind() == DeviceKind::serial) return {device, device};
  if (device.kind() == DeviceKind::egl) return {device, device, with_small_buffers(device)};
  std::vector<Device> devices;
  for (const Isa isa : runnable_isas()) {
    for (const int threads : {1, 2, 3, 8}) devices.push_back(Device::tbb(threads, isa));
  }
  return devices;
}

}  // namespace glint
