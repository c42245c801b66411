// SPDX-License-Identifier: Apache-2.0
// Particles, images and settings whose likelihood ratios are known in closed form.
#pragma once
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <numeric>
#include <vector>

#include "glint/engine/frames/target_appearance.hpp"
#include "glint/engine/trackers/phd/motion_bank.hpp"
#include "glint/engine/trackers/phd/peaks.hpp"
#include "glint/kernels/core/cells.hpp"
#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/particles.hpp"
#include "glint/kernels/core/point_spread.hpp"

namespace glint::test {

/// The window is 5x5 pixels.
inline PointSpread narrow_spread() { return PointSpread::of(0.7); }

/// Sum of the window's squared weights for a target at a pixel centre: B of P-PHD (13).
inline double centred_energy() {
  double energy = 0;
  for (const double w : narrow_spread().centred_weights()) energy += w * w;
  return energy * energy;
}

/// The intensity I with I^2 B / 2 = ln `ratio`: the likelihood ratio of a target at a pixel centre,
/// P-PHD (13), is `ratio` in its own noise-free image and 1 / `ratio` in an empty frame.
inline double intensity_of_ratio(double ratio) {
  return std::sqrt(2 * std::log(ratio) / centred_energy());
}

/// All targets have the intensity of that ratio; nothing about them is random.
inline AppearanceConfig exact_appearance(double ratio) {
  AppearanceConfig c;
  c.psf_sigma = narrow_spread().sigma;
  c.snr_low = c.snr_high =
      20 * std::log10(intensity_of_ratio(ratio) / narrow_spread().intensity_of_snr(0));
  c.intensity_walk = c.jitter = 0;
  return c;
}

inline TargetAppearance ready(const AppearanceConfig& config) {
  TargetAppearance appearance(config);
  appearance.look_at(Scan{});
  return appearance;
}

/// Constant velocity without process noise.
inline MotionConfig exact_motion() {
  MotionConfig c;
  c.process_noise = 0;
  return c;
}

inline constexpr int kSide = 40;

/// The noise-free image of targets at these pixels, kSide x kSide.
inline Frame image_of(double ratio, const std::vector<Pixel>& targets) {
  const PointSpread spread = narrow_spread();
  Image<float> image(kSide, kSide);
  for (const Pixel& t : targets) {
    for (int j = -spread.half_width; j <= spread.half_width; ++j) {
      for (int i = -spread.half_width; i <= spread.half_width; ++i) {
        if (!image.view().contains(t.x + i, t.y + j)) continue;
        image.view()(t.x + i, t.y + j) += static_cast<float>(
            intensity_of_ratio(ratio) * spread.weight(i, 0) * spread.weight(j, 0));
      }
    }
  }
  return Frame(std::move(image));
}

inline Frame empty_frame() { return image_of(2, {}); }

struct TestParticle {
  float x = 0, y = 0, vx = 0, vy = 0, weight = 1, intensity = 1;
  std::uint32_t mode = 0, label = 0;
};

inline Particles particles_of(const std::vector<TestParticle>& list) {
  Particles p;
  p.resize(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const TestParticle& t = list[i];
    p.x[i] = t.x, p.y[i] = t.y, p.vx[i] = t.vx, p.vy[i] = t.vy, p.ax[i] = p.ay[i] = 0;
    p.weight[i] = t.weight, p.intensity[i] = t.intensity, p.mode[i] = t.mode, p.label[i] = t.label;
  }
  return p;
}

inline std::vector<std::uint32_t> all_members(const Particles& p) {
  std::vector<std::uint32_t> members(p.size());
  std::iota(members.begin(), members.end(), 0U);
  return members;
}

}  // namespace glint::test
