// SPDX-License-Identifier: Apache-2.0
// What lies where: the host's memory, copies of it, and what is resident on the device.
#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include "glint/kernels/core/gl_queue.hpp"

namespace glint::gl {
namespace {

/// Makes the host's bytes what no value should be: as floats they are NaN.
void spoil(const Region& region) {
  auto* row = const_cast<std::byte*>(region.data);
  for (std::size_t y = 0; y < region.rows; ++y, row += region.pitch) {
    std::memset(row, 0xFF, region.row_bytes);
  }
}

}  // namespace

void Queue::write_host(Place to, const Region& region) {
  const std::size_t bytes = region.bytes();
  if (bytes == 0) return;
  traffic_.uploaded += bytes;
  timed(traffic_.upload, [&] {
    api_.BindBuffer(Api::kCopyBuffer, to.id);
    void* at = api_.MapBufferRange(Api::kCopyBuffer, static_cast<std::ptrdiff_t>(to.offset),
                                   static_cast<std::ptrdiff_t>(bytes),
                                   Api::kMapWrite | Api::kMapInvalidate);
    check("while sending " + size_text(bytes));
    if (at == nullptr)
      fail(std::string("the driver gives no access to its memory; ") + kSmallerRemedy);
    const std::byte* row = region.data;
    for (std::size_t y = 0; y < region.rows; ++y, row += region.pitch) {
      std::memcpy(static_cast<std::byte*>(at) + y * region.row_bytes, row, region.row_bytes);
    }
    api_.UnmapBuffer(Api::kCopyBuffer);
  });
}

void Queue::read_host(Place from, const Region& region) {
  const std::size_t bytes = region.bytes();
  if (bytes == 0) return;
  traffic_.read += bytes;
  timed(traffic_.read_back, [&] {
    api_.MemoryBarrier(Api::kAllBarriers);
    api_.BindBuffer(Api::kCopyBuffer, from.id);
    const void* at = api_.MapBufferRange(Api::kCopyBuffer, static_cast<std::ptrdiff_t>(from.offset),
                                         static_cast<std::ptrdiff_t>(bytes), Api::kMapRead);
    check("while reading " + size_text(bytes));
    if (at == nullptr)
      fail(std::string("the driver gives no access to its memory; ") + kSmallerRemedy);
    auto* row = const_cast<std::byte*>(region.data);
    for (std::size_t y = 0; y < region.rows; ++y, row += region.pitch) {
      std::memcpy(row, static_cast<const std::byte*>(at) + y * region.row_bytes, region.row_bytes);
    }
    api_.UnmapBuffer(Api::kCopyBuffer);
  });
}

void Queue::copy(Place from, Place to, std::size_t bytes) {
  timed(traffic_.compute, [&] {
    api_.BindBuffer(Api::kCopySource, from.id);
    api_.BindBuffer(Api::kCopyBuffer, to.id);
    api_.CopyBufferSubData(
        Api::kCopySource, Api::kCopyBuffer, static_cast<std::ptrdiff_t>(from.offset),
        static_cast<std::ptrdiff_t>(to.offset), static_cast<std::ptrdiff_t>(bytes));
    api_.MemoryBarrier(Api::kAllBarriers);
  });
  check("while copying " + size_text(bytes));
}

std::optional<Buffer> Queue::borrow(const Region& region) {
  const std::optional<Place> place = residents_.find(region);
  if (!place || place->offset % kAligned != 0 || region.bytes() > max_bytes_) return std::nullopt;
  return Buffer(nullptr, *place, region.bytes());
}

Buffer Queue::upload(const Region& region) {
  if (std::optional<Buffer> resident = borrow(region)) return std::move(*resident);
  Buffer to = take(region.bytes());
  write(to, region, 0);
  return to;
}

Buffer Queue::output(const Region& region) {
  if (std::optional<Buffer> resident = borrow(region)) return std::move(*resident);
  return take(region.bytes());
}

void Queue::write(const Buffer& to, const Region& region, std::size_t offset) {
  Place at = to.place_;
  at.offset += offset;
  if (const std::optional<Place> resident = residents_.find(region)) {
    return copy(*resident, at, region.bytes());
  }
  write_host(at, region);
}

void Queue::read(const Buffer& from, const Region& region, std::size_t offset) {
  Place at = from.place_;
  at.offset += offset;
  const std::optional<Place> resident = residents_.find(region);
  if (!resident) return read_host(at, region);
  if (keeping_ == Keeping::spoiling) spoil(region);
  if (resident->id != at.id || resident->offset != at.offset) copy(at, *resident, region.bytes());
}

void Queue::fill(std::span<float> values, float value) {
  const Region region = region_of(values);
  const std::optional<Place> resident = residents_.find(region);
  if (!resident) {
    std::ranges::fill(values, value);
    return;
  }
  timed(traffic_.compute, [&] {
    api_.BindBuffer(Api::kCopyBuffer, resident->id);
    api_.ClearBufferSubData(
        Api::kCopyBuffer, Api::kFloatWords, static_cast<std::ptrdiff_t>(resident->offset),
        static_cast<std::ptrdiff_t>(region.bytes()), Api::kRed, Api::kFloat, &value);
    api_.MemoryBarrier(Api::kAllBarriers);
  });
  check("while filling " + size_text(region.bytes()));
  if (keeping_ == Keeping::spoiling) spoil(region);
}

void Queue::make_resident(const Region& region) {
  if (keeping_ == Keeping::never || region.bytes() == 0) return;
  Buffer home = allocate(region.bytes());
  if (!residents_.add(region, Residents::Home::only, home.place_.id, home.place_.capacity)) {
    throw std::logic_error("this memory is resident on the device already");
  }
  home.queue_ = nullptr;
}

bool Queue::keep_staged(const Region& region, const StagingSlot& slot, double seconds) {
  if (!residents_.add(region, Residents::Home::copy, slot.id, slot.capacity)) {
    staging_.give_back(slot);
    return false;
  }
  staged_.push_back(slot);
  traffic_.uploaded += region.bytes();
  traffic_.upload += seconds;
  return true;
}

void Queue::drop(const std::byte* region) {
  const auto place = residents_.remove(region);
  if (!place) return;
  const auto staged = std::ranges::find(staged_, place->id, &StagingSlot::id);
  if (staged == staged_.end()) {
    pool_.push_back(*place);
    return;
  }
  staging_.give_back(*staged);
  staged_.erase(staged);
}

void Queue::send(const Region& region) {
  const std::optional<Place> resident = residents_.find(region);
  if (!resident) return;
  write_host(*resident, region);
}

void Queue::fetch(const Region& region) {
  if (const std::optional<Place> resident = residents_.find(region)) read_host(*resident, region);
}

}  // namespace glint::gl
