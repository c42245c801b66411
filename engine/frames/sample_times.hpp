// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <tuple>
#include <vector>

namespace glint {

/// Which frames a running median keeps: at first every frame, then at strides that grow with the
/// stream's age until `slots` samples `stride` frames apart span the window. When all slots are
/// taken, a sample older than the window goes; else the inner one whose neighbours are closest, so
/// that the samples stay spread over all that was seen.
class SampleTimes {
 public:
  SampleTimes(int slots, int stride) : slots_(slots), stride_(stride) {}

  /// True if frame `t`, counted from 0 and ever growing, is due.
  bool due(std::int64_t t) const;
  /// The slot that frame `t` goes to; slots 0 .. size() - 1 are in use.
  int insert(std::int64_t t);
  int size() const { return static_cast<int>(samples_.size()); }
  /// Frames from the oldest sample to the newest.
  std::int64_t span() const;

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.samples_);
  }
  void restored() const;

 private:
  struct Sample {
    std::int64_t time;
    int slot;
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.time, s.slot);
    }
  };
  std::size_t worst(std::int64_t t) const;

  int slots_, stride_;
  std::vector<Sample> samples_;  ///< oldest first
};

}  // namespace glint
