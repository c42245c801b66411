// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/tracks/two_point_starts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace glint {

std::span<const TwoPointStart> TwoPointStarts::next(const ScanPoints& points,
                                                    double least_amplitude, double reach) {
  std::swap(free_, free_before_);
  free_.clear();
  for (std::size_t j = 0; j < points.positions.size(); ++j) {
    const double amplitude = points.amplitudes[j];
    if (!points.free(j) || amplitude < least_amplitude) continue;
    free_.push_back({points.positions[j], std::isfinite(amplitude) ? amplitude : 0});
  }
  return find(free_before_, free_, reach);
}

std::span<const TwoPointStart> TwoPointStarts::find(std::span<const FreePoint> before,
                                                    std::span<const FreePoint> now, double reach) {
  candidates_.clear(), starts_.clear();
  for (std::size_t b = 0; b < now.size(); ++b) {
    for (std::size_t a = 0; a < before.size(); ++a) {
      const double distance = (now[b].position - before[a].position).norm();
      if (distance > reach) continue;
      candidates_.push_back({before[a].amplitude + now[b].amplitude, distance, a, b});
    }
  }
  std::ranges::sort(candidates_, [](const Candidate& a, const Candidate& b) {
    return std::tie(b.amplitude, a.distance, a.now, a.before) <
           std::tie(a.amplitude, b.distance, b.now, b.before);
  });
  taken_before_.assign(before.size(), false), taken_now_.assign(now.size(), false);
  for (const Candidate& c : candidates_) {
    if (taken_before_[c.before] || taken_now_[c.now]) continue;
    taken_before_[c.before] = taken_now_[c.now] = true;
    starts_.push_back({before[c.before], now[c.now]});
  }
  return starts_;
}

}  // namespace glint
