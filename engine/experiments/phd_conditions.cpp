// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/experiments/phd_conditions.hpp"

#include <cmath>

namespace glint {
namespace {

constexpr double kSigma = 0.7;  // of the point spread [px]
// Th for a detection probability of .99 by the maximum of a 3x3 neighbourhood [noise sigmas].
constexpr std::array kThreshold{1.851, 1.461, 1.176};

/// Process noise as a multiple of the paper's densities, .001 for motion and .01 for intensity.
void set_process_noise(double multiple, SmcPhdConfig& config) {
  config.process_noise = 0.001 * multiple;
  config.intensity_walk = std::sqrt(0.01 * multiple) / PointSpread::of(kSigma).intensity_of_snr(0);
}

/// P-PHD table 1 and section 5.1.
SmcPhdConfig paper_settings(std::size_t level) {
  SmcPhdConfig config;
  config.psf_sigma = kSigma;
  config.snr_low = kPhdSnr[level] + 20 * std::log10(0.8);
  config.snr_high = kPhdSnr[level] + 20 * std::log10(1.2);
  config.motion = "cv";
  config.speed_max = 4;
  config.survival = 0.99;
  config.birth_particles = 2000;
  config.birth_mass = 0.05;
  config.birth_threshold = kThreshold[level];
  config.particles_per_target = config.particles_max = 4000;
  config.existence = 0.5;
  config.cluster_radius = 2.5;
  config.identity.separation = 0;  // every state is scored
  return config;
}

SmcPhdConfig standard(std::size_t level) {
  SmcPhdConfig config = paper_settings(level);
  config.birth = "uniform";
  config.jitter = 0;
  set_process_noise(1, config);
  return config;
}

SmcPhdConfig two_frame(std::size_t level) {
  SmcPhdConfig config = paper_settings(level);
  config.birth = "two-frame";
  config.jitter = 0.5;
  set_process_noise(20, config);
  return config;
}

SmcPhdConfig literal_standard(std::size_t level) {
  SmcPhdConfig config = standard(level);
  config.states = "kmeans";
  config.psi = "cell";
  config.clutter = 0.5 * std::erfc(kThreshold[level] / std::sqrt(2.0));  // 1 - Phi(Th)
  return config;
}

PhdBands at_most(double at_12, double at_10, double at_8) {
  return {Band{{}, at_12}, Band{{}, at_10}, Band{{}, at_8}};
}

}  // namespace

std::vector<PhdCondition> phd_conditions() {
  const PhdBands one_target{Band{0.75, 1.2}, Band{0.75, 1.2}, {}};
  const PhdBands as_bad_as_printed{Band{4.2, {}}, Band{4.2, {}}, Band{4.2, {}}};
  return {
      {"standard", standard, true, {}, one_target},
      {"two-frame", two_frame, true, at_most(1.1, 1.65, 2.6), one_target},
      {"literal standard", literal_standard, true, as_bad_as_printed, {}},
      {"standard, noise only", standard, false, {}, at_most(0.35, 0.35, 0.35)},
      {"two-frame, noise only", two_frame, false, {}, at_most(0.1, 0.1, 0.1)},
  };
}

}  // namespace glint
