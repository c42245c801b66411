// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/gl_staging.hpp"

#include <algorithm>
#include <limits>

namespace glint::gl {

Staging::~Staging() {
  reap(std::numeric_limits<std::uint64_t>::max());
  for (const StagingSlot& slot : free_) api_.DeleteBuffers(1, &slot.id);
}

std::optional<StagingSlot> Staging::take(std::size_t bytes) {
  const std::scoped_lock lock(mutex_);
  const auto found = std::ranges::find(free_, bytes, &StagingSlot::capacity);
  if (found == free_.end()) return std::nullopt;
  const StagingSlot slot = *found;
  free_.erase(found);
  return slot;
}

std::optional<StagingSlot> Staging::make(std::size_t bytes) {
  if (in_use_.size() >= kMost) {
    reap(std::numeric_limits<std::uint64_t>::max());
    if (const auto slot = take(bytes)) return slot;
  }
  // Frames of another size: what is free is of no use any more.
  const std::scoped_lock lock(mutex_);
  for (const StagingSlot& old : free_) api_.DeleteBuffers(1, &old.id);
  free_.clear();
  constexpr unsigned kMapping = Api::kMapWrite | Api::kMapPersistent | Api::kMapCoherent;
  StagingSlot slot{0, nullptr, bytes};
  const auto size = static_cast<std::ptrdiff_t>(bytes);
  api_.GenBuffers(1, &slot.id);
  api_.BindBuffer(Api::kCopyBuffer, slot.id);
  api_.BufferStorage(Api::kCopyBuffer, size, nullptr, kMapping);
  slot.at = static_cast<std::byte*>(api_.MapBufferRange(Api::kCopyBuffer, 0, size, kMapping));
  if (api_.GetError() == 0 && slot.at != nullptr) return slot;
  api_.DeleteBuffers(1, &slot.id);
  return std::nullopt;
}

void Staging::give_back(const StagingSlot& slot) {
  reap(0);
  in_use_.push_back({slot, api_.FenceSync(Api::kGpuDone, 0)});
}

/// Frees the slots that are done with, waiting up to `timeout` [ns] for each.
void Staging::reap(std::uint64_t timeout) {
  while (!in_use_.empty()) {
    const InUse& oldest = in_use_.front();
    const unsigned flush = timeout > 0 ? Api::kFlushCommands : 0;
    if (api_.ClientWaitSync(oldest.fence, flush, timeout) == Api::kTimeoutExpired) return;
    api_.DeleteSync(oldest.fence);
    const std::scoped_lock lock(mutex_);
    free_.push_back(oldest.slot);
    in_use_.pop_front();
  }
}

}  // namespace glint::gl
