// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/sample_times.hpp"

#include <algorithm>

#include "glint/engine/state/bytes.hpp"

namespace glint {

bool SampleTimes::due(std::int64_t t) const {
  if (samples_.empty()) return true;
  const std::int64_t growing = (t + slots_ - 1) / slots_;
  return t - samples_.back().time >= std::clamp<std::int64_t>(growing, 1, stride_);
}

std::size_t SampleTimes::worst(std::int64_t t) const {
  const std::int64_t window = static_cast<std::int64_t>(slots_) * stride_;
  if (samples_.size() < 3 || t - samples_.front().time >= window) return 0;
  std::size_t found = 1;
  for (std::size_t i = 1; i + 1 < samples_.size(); ++i) {
    const auto gap = [&](std::size_t k) { return samples_[k + 1].time - samples_[k - 1].time; };
    if (gap(i) < gap(found)) found = i;
  }
  return found;
}

int SampleTimes::insert(std::int64_t t) {
  int slot = size();
  if (slot == slots_) {
    const auto leaving = samples_.begin() + static_cast<std::ptrdiff_t>(worst(t));
    slot = leaving->slot;
    samples_.erase(leaving);
  }
  samples_.push_back({t, slot});
  return slot;
}

void SampleTimes::restored() const {
  require_bytes(size() <= slots_, "the background has too many samples");
  for (const Sample& sample : samples_) {
    require_frame_number(sample.time);
    require_bytes(sample.slot >= 0 && sample.slot < size(), "the background has no such sample");
  }
}

std::int64_t SampleTimes::span() const {
  return samples_.empty() ? 0 : samples_.back().time - samples_.front().time;
}

}  // namespace glint
