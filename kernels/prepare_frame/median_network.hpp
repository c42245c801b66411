// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "glint/kernels/prepare_frame/background.hpp"

namespace glint {

/// Compare-exchanges that bring the middle of n values to their places, and nothing more: Batcher's
/// merge exchange (Knuth 5.2.2 M) without the steps and the halves of steps that no middle value
/// depends on.
struct MedianNetwork {
  struct Step {
    std::uint8_t low, high;  ///< indices: after the step, value[low] <= value[high]
    bool keep_low, keep_high;
  };
  int inputs = 0, count = 0;
  int lower = 0, upper = 0;  ///< indices of the two middle values; the same for odd n
  Step steps[640];
};

/// For n in 1 .. kMaxStack.
MedianNetwork median_network(int n);

}  // namespace glint
