// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/device.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint/kernels/core/tiles.hpp"

namespace glint {
namespace {

constexpr std::string_view kNumbered = "egl:";

/// The N of "egl:N", or -1.
int number_of(std::string_view kind) {
  if (!kind.starts_with(kNumbered)) return -1;
  const char* const end = kind.data() + kind.size();
  int number = -1;
  const auto [rest, error] = std::from_chars(kind.data() + kNumbered.size(), end, number);
  return error == std::errc() && rest == end ? number : -1;
}

}  // namespace

std::string_view name(DeviceKind kind) {
  constexpr std::array<std::string_view, 3> kNames{"serial", "tbb", "egl"};
  return kNames[static_cast<std::size_t>(kind)];
}

Device Device::egl(int number, int threads) {
  Device device(DeviceKind::egl, threads, best_isa());
  device.context_ = open_egl_device(number);
  return device;
}

Device Device::named(std::string_view kind, int threads) {
  if (kind == "serial") return serial();
  if (kind == "tbb" || kind == "auto") return tbb(threads);
  if (kind == "egl") return egl(kAnyEglDevice, threads);
  if (const int number = number_of(kind); number >= 0) return egl(number, threads);
  throw std::invalid_argument("device '" + std::string(kind) +
                              "' is not known: use auto, serial, tbb, egl or egl:N");
}

Resident Device::make_region_resident(const Region& region) const {
  if (kind_ != DeviceKind::egl) return {};
  context_->run([&](gl::Queue& queue) { queue.make_resident(region); });
  return {context_, region.data};
}

Resident Device::stage_region(const Region& region) const {
  if (kind_ != DeviceKind::egl || region.bytes() == 0) return {};
  const std::optional<gl::StagingSlot> slot = context_->staging_slot(region.bytes());
  if (!slot) return {};  // then it goes up when a kernel asks for it
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t y = 0; y < region.rows; ++y) {
    std::memcpy(slot->at + y * region.row_bytes,
                region.data + static_cast<std::ptrdiff_t>(y) * region.pitch, region.row_bytes);
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  bool staged = false;
  context_->run(
      [&](gl::Queue& queue) { staged = queue.keep_staged(region, *slot, taken.count()); });
  return staged ? Resident(context_, region.data) : Resident();
}

bool Device::fits(const WholeCall& call) const { return call.bytes <= context_->max_bytes(); }

void Device::on_host(const WholeCall& call, FunctionRef<void()> run) const {
  for (const Region& region : call.read) fetch_region(region);
  run();
  for (const Region& region : call.written) send_region(region);
}

void Device::send_region(const Region& region) const {
  context_->run([&](gl::Queue& queue) { queue.send(region); });
}

void Device::fetch_region(const Region& region) const {
  context_->run([&](gl::Queue& queue) { queue.fetch(region); });
}

void Device::copy_region(const Region& from, const Region& to) const {
  if (kind_ == DeviceKind::egl) {
    return context_->run([&](gl::Queue& queue) { queue.copy(from, to); });
  }
  const Tiles rows{from.rows, kRowTile};
  workers_->for_tiles(rows.tiles(), [&](std::size_t tile) {
    for (std::size_t y = rows.begin(tile); y < rows.end(tile); ++y) {
      const auto row = static_cast<std::ptrdiff_t>(y);
      std::memcpy(const_cast<std::byte*>(to.data) + row * to.pitch, from.data + row * from.pitch,
                  from.row_bytes);
    }
  });
}

void Device::fill(std::span<float> values, float value) const {
  if (kind_ == DeviceKind::egl) {
    return context_->run([&](gl::Queue& queue) { queue.fill(values, value); });
  }
  std::ranges::fill(values, value);
}

void Resident::fetch(const Region& region) const {
  if (memory_ != nullptr) context_->run([&](gl::Queue& queue) { queue.fetch(region); });
}

Resident::~Resident() {
  if (memory_ == nullptr) return;
  context_->run([&](gl::Queue& queue) { queue.drop(memory_); });
}

std::string Device::description() const {
  if (kind_ == DeviceKind::serial) return "serial (double precision reference, 1 thread)";
  if (kind_ == DeviceKind::egl) return glint::description(context_->device());
  return "tbb (" + std::to_string(workers_->threads()) + " threads, " +
         std::string(glint::name(workers_->isa())) + ")";
}

}  // namespace glint
