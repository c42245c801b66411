// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/bench/bench.hpp"

namespace glint::bench {

// One suite a piece of work. Targets of frame-sized work hold for kReferenceSize.
Suite pixel_likelihood_float(FrameSize size);
Suite pixel_likelihood_u16(FrameSize size);
Suite pixel_likelihood_hits(FrameSize size);
Suite pixel_likelihood_growth();
Suite particle_likelihood_clouds(FrameSize size);
Suite particle_likelihood_spread(FrameSize size);
Suite particle_likelihood_growth();
Suite propagate_constant_velocity();
Suite propagate_growth();
Suite resample_ancestors();
Suite resample_moves();
Suite resample_growth();
Suite cell_weights_clouds(FrameSize size);
Suite find_points_noise(FrameSize size);
Suite dp_stage_noise(FrameSize size);
Suite prepare_frames(FrameSize size);
Suite cell_integrals_one();
Suite cell_integrals_hundred();
Suite cell_integrals_many(FrameSize size);
Suite cell_integrals_growth();
/// Every kernel's parity trials, so that a new kernel shows here before it has a suite.
Suite kernel_trials();
/// The same trials of the kernels that an egl device runs itself, on it and on tbb.
Suite egl_trials(const Device& egl);
/// The kernels that a scan's time goes to, on large problems: their shaders alone, and with what
/// travels both ways, beside the device's own copy of a buffer and beside tbb.
Result egl_bandwidth(const Device& egl, FrameSize size, bool quick);

}  // namespace glint::bench
