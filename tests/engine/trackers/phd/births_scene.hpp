// SPDX-License-Identifier: Apache-2.0
// Births in small frames, and the scores that they are drawn by.
#pragma once
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "engine/trackers/phd/few_particles.hpp"
#include "glint/engine/trackers/phd/births.hpp"

namespace glint::test {

inline constexpr int kCount = 4000;
inline constexpr double kMass =
    1e-6;                            // so little that it does not fill the normaliser of P-PHD (14)
inline constexpr double kSpeed = 2;  // px/frame

inline BirthConfig config_of(BirthProposal proposal) {
  BirthConfig c;
  c.birth = proposal, c.birth_particles = kCount, c.birth_mass = kMass, c.birth_threshold = 1;
  return c;
}

inline MotionConfig motion_of() {
  MotionConfig c;
  c.motion = "cv+ct", c.speed_max = kSpeed;
  return c;
}

/// One after the other frame, each of them one step on.
class Nursery {
 public:
  explicit Nursery(const BirthConfig& config, const AppearanceConfig& appearance)
      : births_(config, motion_of(), Device::serial(), 1) {
    births_.set_appearance(ready(appearance));
  }
  /// The particles born in frame `z`, behind three that were there before.
  Particles draw(const Frame& z, double step = 1) {
    constexpr std::size_t kBefore = 3;
    Particles p;
    const BirthScan scan{z, ++frame_, step, previous, clutter, mask};
    const std::size_t born = births_.prepare(scan);
    p.resize(kBefore + born);
    births_.draw(scan, p, kBefore);
    Particles out;
    out.resize(born);
    std::apply(
        [&](auto&... to) {
          std::apply(
              [&](const auto&... from) {
                (std::copy_n(from.begin() + kBefore, born, to.begin()), ...);
              },
              Particles::fields(p));
        },
        Particles::fields(out));
    return out;
  }
  CellWorkspace previous;
  double clutter = 1;
  PixelMask mask;

 private:
  Births births_;
  std::int64_t frame_ = 0;
};

/// So dim that every likelihood ratio is 1 within half a percent.
inline AppearanceConfig dim() { return exact_appearance(1.001); }

inline int pixel_of(double x) { return static_cast<int>(std::floor(x + 0.5)); }

/// exp(r / 2), with r the log-likelihood ratio of a target at the centre of a pixel, over the part
/// of its window inside the frame. P-PHD (13)
inline std::vector<double> scores_of(FrameView z, double intensity) {
  const PointSpread spread = narrow_spread();
  std::vector<double> scores;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      double matched = 0, energy = 0;
      for (int j = -spread.half_width; j <= spread.half_width; ++j) {
        for (int i = -spread.half_width; i <= spread.half_width; ++i) {
          if (!z.contains(x + i, y + j)) continue;
          const double w = spread.weight(i, 0) * spread.weight(j, 0);
          matched += w * z(x + i, y + j);
          energy += w * w;
        }
      }
      const double r = intensity * matched - intensity * intensity * energy / 2;
      scores.push_back(std::exp(std::clamp(r, -8.0, 20.0) / 2));
    }
  }
  return scores;
}

inline double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace glint::test
