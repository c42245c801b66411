// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "glint/kernels/core/random.hpp"
#include "glint/kernels/core/trial.hpp"

namespace glint {

enum class Motion : std::uint32_t { constant_velocity, constant_acceleration, coordinated_turn };

/// One motion model of a bank. The unit of time is that of Propagate::Args::step, "step" below.
struct MotionMode {
  Motion motion = Motion::constant_velocity;
  /// [rad/step], turns only; positive turns the stored velocity (vx, vy) so that atan2(vy, vx)
  /// grows: anticlockwise on a plot with y up (AC-CT), clockwise on a screen with y down.
  float turn_rate = 0;
  /// Power spectral density of the driving noise per axis: of acceleration for CV and turns
  /// [px^2/step^3], of jerk for CA [px^2/step^5].
  float noise = 1e-3f;
};

/// Moves particles one step: switches each one's model by a Markov chain, then by the new model
/// x' = F x + w, I' = I + w_I reflected into its range. P-PHD (1), (31), (32), (34). CV and turns
/// leave accelerations as they are. Particle i draws the same numbers wherever and in whatever
/// parts it is computed. Throws std::invalid_argument for arrays of unlike lengths, modes without
/// switching rows that sum to 1, negative noise or step, or low > high.
struct Propagate {
  static constexpr std::string_view name = "propagate";
  /// Of every component, for |x| <= 1e4 px: float arithmetic.
  static constexpr Tolerance tolerance{5e-4, 1e-6};
  static constexpr std::size_t kMaxModes = 8;

  struct Args {
    std::span<float> x, y, vx, vy, intensity;  ///< in place
    std::span<float> ax, ay;                   ///< in place; may be empty if no mode is CA
    std::span<std::uint32_t> mode;             ///< in place; may be empty if there is one mode
    std::span<const MotionMode> modes;         ///< 1 to kMaxModes; a particle's larger mode counts
                                               ///< as the last one
    std::span<const float> switching;          ///< modes x modes, row = from; empty if one mode
    float step = 1;                            ///< how far time moves; velocities are per 1
    float intensity_noise = 0;                 ///< power spectral density q_i [sigma^2/step]
    float intensity_low = 0, intensity_high = 1;
    std::span<const float> noise_scale = {};  ///< per particle, multiplies all its noise's standard
                                              ///< deviations; empty means 1. P-PHD (21)
    std::uint64_t seed = 0;
    std::uint32_t frame = 0;
  };
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
  static std::vector<std::unique_ptr<Trial>> trials();
};

}  // namespace glint
