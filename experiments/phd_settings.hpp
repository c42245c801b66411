// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "glint/experiments/tracker_setup.hpp"

namespace glint::phd {

/// What a target looks like: psf_sigma [px], and an intensity within 20 % of that of `snr` [dB].
Settings appearance(double psf_sigma, double snr_low, double snr_high);

/// Process noise as a multiple of the paper's densities at an interval of `step` [s]: .001 px^2/s^3
/// for motion and .01 for the intensity of a point spread of `psf_sigma`.
Settings process_noise(double multiple, double psf_sigma, double step);

/// P-PHD table 1: particles and rates of the particle filters.
Settings table_1(int birth_particles);

/// A particle filter's one setting for dim targets of all levels, on the scenes `dim-target` and
/// `dim-field`. White noise has no residues of a background, which more hits of `mm-phd` are for.
TrackerSetup dim_target_setup(const std::string& tracker);

}  // namespace glint::phd
