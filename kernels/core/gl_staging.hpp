// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

#include "glint/kernels/core/gl_api.hpp"

namespace glint::gl {

/// Memory that the host writes and passes read: mapped for good, so that any thread may fill it
/// while the device works on.
struct StagingSlot {
  unsigned id = 0;           ///< the buffer
  std::byte* at = nullptr;   ///< where the host sees it
  std::size_t capacity = 0;  ///< [bytes]
};

/// Slots that frames go up through. All but take() on the context's thread only.
class Staging {
 public:
  explicit Staging(const Api& api) : api_(api) {}
  ~Staging();
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  /// Whether the driver has such memory.
  bool possible() const { return api_.BufferStorage != nullptr; }
  /// From any thread: a slot of this size that no pass reads any more, if there is one.
  std::optional<StagingSlot> take(std::size_t bytes);
  /// A new slot, or the oldest of those in use once no pass reads it. Nothing if memory runs out.
  std::optional<StagingSlot> make(std::size_t bytes);
  /// What was given to the device up to now may still read the slot; then it is free.
  void give_back(const StagingSlot& slot);

 private:
  static constexpr std::size_t kMost = 3;  ///< slots: one being filled, one read, one to spare
  struct InUse {
    StagingSlot slot;
    Handle fence;
  };
  void reap(std::uint64_t timeout);

  const Api& api_;
  std::mutex mutex_;
  std::vector<StagingSlot> free_;  ///< guarded by mutex_
  std::deque<InUse> in_use_;       ///< oldest first
};

}  // namespace glint::gl
