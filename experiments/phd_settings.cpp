// SPDX-License-Identifier: Apache-2.0
#include "glint/experiments/phd_settings.hpp"

#include <cmath>

#include "glint/kernels/core/point_spread.hpp"

namespace glint::phd {

Settings appearance(double psf_sigma, double snr_low, double snr_high) {
  return {{"psf_sigma", psf_sigma},
          {"snr_low", snr_low + 20 * std::log10(0.8)},
          {"snr_high", snr_high + 20 * std::log10(1.2)}};
}

Settings process_noise(double multiple, double psf_sigma, double step) {
  // In frames for seconds: velocities grow by `step`, their variance by step^2 a frame of `step`.
  const double walk = std::sqrt(0.01 * multiple * step);
  return {{"process_noise", 0.001 * multiple * step * step * step},
          {"intensity_walk", walk / PointSpread::of(psf_sigma).intensity_of_snr(0)}};
}

Settings table_1(int birth_particles) {
  return {{"survival", 0.99},
          {"birth_particles", std::int64_t{birth_particles}},
          {"birth_mass", 0.05},
          {"particles_per_target", std::int64_t{4000}}};
}

TrackerSetup dim_target_setup(const std::string& tracker) {
  TrackerSetup setup{tracker, {{"snr_low", 2.0}, {"snr_high", 16.0}}};
  if (tracker == "mm-phd") setup.settings.push_back({"confirm_hits", 3});
  return setup;
}

}  // namespace glint::phd
