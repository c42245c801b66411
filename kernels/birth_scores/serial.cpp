// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "glint/kernels/birth_scores/birth_scores.hpp"

namespace glint {

void BirthScores::serial(const Args& a) {
  const double intensity = a.intensity, energy = a.energy;
  for (int y = 0; y < a.map.height; ++y) {
    for (int x = 0; x < a.map.width; ++x) {
      // The map is I A - I^2 B / 2, P-PHD (13): get A back, then maximise over I.
      const double correlation = a.map(x, y) / intensity + intensity * energy / 2;
      const double best =
          std::clamp<double>(correlation / energy, a.intensity_low, a.intensity_high);
      const double ratio = best * (correlation - best * energy / 2);
      a.score(x, y) = static_cast<float>(std::exp(std::clamp<double>(ratio, a.low, a.high) / 2));
    }
  }
}

}  // namespace glint
