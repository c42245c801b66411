// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <tuple>

#include "glint/engine/frames/target_appearance.hpp"
#include "glint/engine/scan.hpp"
#include "glint/engine/trackers/phd/births.hpp"
#include "glint/engine/trackers/phd/motion_bank.hpp"
#include "glint/engine/trackers/phd/pixel_mask.hpp"
#include "glint/engine/trackers/phd/resident_particles.hpp"
#include "glint/kernels/cell_weights/cell_weights.hpp"
#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/particles.hpp"
#include "glint/kernels/core/resident_memory.hpp"
#include "glint/kernels/resample/resample.hpp"

namespace glint {

/// How targets move. The unit of time is the frame interval, whatever the frame rate.
struct MotionConfig {
  std::string motion = "cv";
  double process_noise = 0.02;  ///< [px^2/frame^3]
  double turn_rate = 15;        ///< [deg/frame]
  double speed_max = 4;         ///< [px/frame]
  double survival = 0.99;
  MotionBank bank() const;
};
void describe(FieldList& f, MotionConfig& c);

/// Settings of a particle cloud that looks for targets all over the frame.
struct PhdFilterConfig : AppearanceConfig, MotionConfig {
  // Where targets come from.
  std::string birth = "two-frame";
  int birth_particles = 4000;
  double birth_mass = 0.05;
  double birth_threshold = 1.5;  ///< [noise sigmas]
  // How many particles stand for them.
  int particles_per_target = 2000;
  int particles_max = 2000000;
  std::string resampling = "systematic", resample_on = "weight";
  // How their pixels are shared.
  std::string psi = "window";
  double clutter = 1;
};
void describe(FieldList& f, PhdFilterConfig& c);

/// What the weights of a cloud sum to after the update.
enum class CloudWeight {
  expected_targets,  ///< pixels are shared out among the particles: P-PHD (14)
  odds               ///< w l alone: posterior odds of one target against none
};

/// A cloud of particles that looks for targets: the PHD filter of P-PHD section 3.1, over all
/// motion models of section 4. A scan is predict(), update(), then resample().
class PhdFilter {
 public:
  PhdFilter(const PhdFilterConfig& config, const Device& device, std::uint64_t seed,
            CloudWeight weight = CloudWeight::expected_targets);
  /// Sets what targets look like; a change of shape empties the cloud.
  void set_appearance(const TargetAppearance& appearance);

  /// Survivors move, births join. P-PHD (9)-(11), (31)-(34). `step` frames have passed since the
  /// last call; nothing lives or is born in `mask`; `noise_scale` multiplies the process noise's
  /// standard deviation of each survivor, empty = 1.
  void predict(const Frame& z, std::int64_t frame, double step, const PixelMask& mask,
               std::span<const float> noise_scale = {});
  /// P-PHD (13)-(16): likelihood over the window, w l / (clutter + B).
  void update(const Frame& z, std::int64_t frame);
  /// Takes these particles away, weight and all.
  void remove(std::span<const std::uint32_t> members);
  /// Takes everything away.
  void clear();
  /// Particles of equal weight, their sum kept. P-PHD (20); (24) as corrected if so configured.
  void resample(std::int64_t frame);

  /// Sum of the weights after the update: expected number of targets, P-PHD (19), or odds.
  double expected() const { return expected_; }
  /// Fetched from the device. Who changes labels is to send_labels(); nothing else may be changed.
  Particles& particles();
  std::span<const std::uint32_t> labels();
  void send_labels();
  std::size_t size() const { return particles_.size(); }
  /// The particles by pixel, of the last update.
  const CellRuns& runs() const { return cells_.runs; }

  // Of the cells, births ask for what the last update found there.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.appearance_, s.births_, s.particles_, s.cells_.runs.cell, s.cells_.cell_sum,
                    s.expected_, s.weight_of_each_);
  }
  void restored() const;

 private:
  void give_birth(const Frame& z, std::int64_t frame, double step, const PixelMask& mask);
  void set_survivors(const PixelMask& mask);
  void turn_to_odds();

  PhdFilterConfig config_;
  MotionBank bank_;
  Device device_;
  std::uint64_t seed_;
  CloudWeight weight_;
  TargetAppearance appearance_;
  Births births_;
  ResidentParticles particles_, moved_;
  bool fetched_ = false;      ///< particles_, since they were last moved or weighed
  float weight_of_each_ = 0;  ///< after resampling
  ResidentArray<float> log_ratio_, updated_;
  ResidentArray<float> likelihood_;  ///< w_{k|k-1} l, if the cloud is redrawn by it; else empty
  CellWorkspace cells_;
  ResampleWorkspace draws_;
  ResidentArray<std::uint32_t> ancestors_;
  double expected_ = 0;
};

}  // namespace glint
