// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "glint/bench/memory_source.hpp"
#include "glint/engine/scheduler.hpp"

namespace glint::bench {

/// 1024x1024 pixels, 20 targets at 10 dB that a tracker of frames and one of points both follow.
MemoryScene dim_stream();

/// An engine on a stream without an end: its trackers, with their defaults, are warm after the
/// first call of advance() and stay so.
class WarmEngine {
 public:
  WarmEngine(std::shared_ptr<const MemoryScene> scene, const std::vector<std::string>& trackers,
             const Device& device);
  /// The next frames of the stream.
  void advance(std::int64_t frames);
  const Scheduler& scheduler() const { return scheduler_; }

 private:
  std::shared_ptr<const MemoryScene> scene_;
  MemorySource source_;
  Scheduler scheduler_;
};

}  // namespace glint::bench
