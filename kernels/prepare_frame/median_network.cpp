// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/prepare_frame/median_network.hpp"

#include <array>
#include <bit>

namespace glint {
namespace {

/// The whole sorting network.
void merge_exchange(MedianNetwork& network) {
  const int n = network.inputs;
  if (n < 2) return;
  const int top = static_cast<int>(std::bit_ceil(static_cast<unsigned>(n))) / 2;
  for (int p = top; p > 0; p /= 2) {
    int q = top, r = 0, d = p;
    while (true) {
      for (int i = 0; i + d < n; ++i) {
        if ((i & p) != r) continue;
        network.steps[network.count++] = {static_cast<std::uint8_t>(i),
                                          static_cast<std::uint8_t>(i + d), true, true};
      }
      if (q == p) break;
      d = q - p, q /= 2, r = p;
    }
  }
}

}  // namespace

MedianNetwork median_network(int n) {
  MedianNetwork network;
  network.inputs = n, network.lower = (n - 1) / 2, network.upper = n / 2;
  merge_exchange(network);
  std::array<bool, kMaxStack> needed{};
  needed[static_cast<std::size_t>(network.lower)] = true;
  needed[static_cast<std::size_t>(network.upper)] = true;
  int kept = network.count;
  for (int s = network.count - 1; s >= 0; --s) {
    MedianNetwork::Step step = network.steps[s];
    step.keep_low = needed[step.low], step.keep_high = needed[step.high];
    if (!step.keep_low && !step.keep_high) continue;
    needed[step.low] = needed[step.high] = true;
    network.steps[--kept] = step;
  }
  for (int s = kept; s < network.count; ++s) network.steps[s - kept] = network.steps[s];
  network.count -= kept;
  return network;
}

}  // namespace glint
