// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <tuple>

#include "glint/engine/cue.hpp"
#include "glint/engine/frames/target_appearance.hpp"
#include "glint/engine/scan.hpp"
#include "glint/engine/trackers/phd/births.hpp"
#include "glint/engine/trackers/phd/motion_bank.hpp"
#include "glint/engine/trackers/phd/pixel_mask.hpp"
#include "glint/engine/trackers/phd/resident_particles.hpp"
#include "glint/engine/tracks/step_clock.hpp"
#include "glint/kernels/cell_weights/cell_weights.hpp"
#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/particles.hpp"
#include "glint/kernels/core/resident_memory.hpp"
#include "glint/kernels/resample/resample.hpp"

namespace glint {

/// What particles are redrawn by: their weight, or their likelihood alone, P-PHD (24).
enum class ResampleOn { weight, likelihood };

/// Settings of a particle PHD filter.
struct PhdFilterConfig : AppearanceConfig, MotionConfig, BirthConfig {
  // How many particles stand for them.
  int particles_per_target = 2000;
  int particles_max = 2000000;
  Resampling resampling = Resampling::systematic;
  ResampleOn resample_on = ResampleOn::weight;
  // How their pixels are shared.
  Psi psi = Psi::window;
  double clutter = 1;
};
void describe(FieldList& f, PhdFilterConfig& c);

/// What the weights of a target's particles sum to after the update.
enum class WeightSum {
  expected_targets,  ///< 1 at most; each pixel is shared among its particles: P-PHD (14)
  odds               ///< its posterior odds against none, w l; particles are redrawn by the other
};

/// The particle PHD filter of P-PHD section 3.1 over all motion models of section 4: it looks for
/// targets in the whole frame. Each scan takes predict(), update(), then resample().
class PhdFilter {
 public:
  PhdFilter(const PhdFilterConfig& config, const Device& device, std::uint64_t seed,
            WeightSum weight_sum = WeightSum::expected_targets);
  /// Sets what targets look like and removes all particles: their intensities were for another
  /// point spread.
  void set_appearance(const TargetAppearance& appearance);

  /// Moves the survivors and adds new-born particles. P-PHD (9)-(11), (31)-(34). `step` [frame] is
  /// the time since the last call; particles in `mask` lose their weight and none are born there;
  /// `noise_scale` multiplies the process noise's standard deviation of each survivor, empty = 1.
  void predict(const Frame& z, std::int64_t frame, double step, const PixelMask& mask,
               std::span<const float> noise_scale = {});
  /// After predict(): adds particles about a cue that sum to `mass` and carry `label`.
  void add(const Cue& cue, const StepTime& at, double mass, std::uint32_t label);
  /// P-PHD (13)-(16): likelihood over the window, w l / (clutter + B).
  void update(const Frame& z, std::int64_t frame);
  /// Sets the weights of these particles to 0.
  void remove(std::span<const std::uint32_t> members);
  /// Removes all particles.
  void clear();
  /// Redraws particles of equal weight with the same sum. P-PHD (20); (24) as corrected if so
  /// configured.
  void resample(std::int64_t frame);

  /// Expected number of targets after the update, P-PHD (19).
  double expected() const { return expected_; }
  const TargetAppearance& appearance() const { return appearance_; }
  /// Fetched from the device. Only labels may be changed; call send_labels() after that.
  Particles& particles();
  std::span<const std::uint32_t> labels();
  void send_labels();
  std::size_t size() const { return particles_.size(); }
  /// The particles by pixel, of the last update.
  const CellRuns& runs() const { return cells_.runs; }

  // Births use the cells of the last update.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.appearance_, s.births_, s.particles_, s.cells_.runs.cell, s.cells_.cell_sum,
                    s.expected_, s.weight_of_each_);
  }
  void restored() const;

 private:
  void give_birth(const Frame& z, std::int64_t frame, double step, const PixelMask& mask);
  void set_survivors(const PixelMask& mask);
  void bound_odds();
  void weigh_anew(std::size_t kept);
  bool odds() const { return weight_sum_ == WeightSum::odds; }

  PhdFilterConfig config_;
  MotionBank bank_;
  Device device_;
  std::uint64_t seed_;
  WeightSum weight_sum_;
  TargetAppearance appearance_;
  Births births_;
  ResidentParticles particles_, moved_;
  bool fetched_ = false;      ///< whether particles_ are on the host as they are on the device
  float weight_of_each_ = 0;  ///< after resampling; odds have their own
  ResidentArray<float> log_ratio_, updated_;
  ResidentArray<float> drawn_by_;  ///< what particles are redrawn by, if not by weight; else empty
  CellWorkspace cells_;
  ResampleWorkspace draws_;
  ResidentArray<std::uint32_t> ancestors_;
  double expected_ = 0;
};

}  // namespace glint
