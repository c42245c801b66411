// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "glint/engine/cue.hpp"
#include "glint/engine/frames/target_appearance.hpp"
#include "glint/engine/trackers/phd/motion_bank.hpp"
#include "glint/engine/trackers/phd/peaks.hpp"
#include "glint/engine/tracks/step_clock.hpp"
#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/particles.hpp"
#include "glint/kernels/core/random.hpp"
#include "glint/kernels/resample/resample.hpp"

namespace glint {

/// The update of one target by one frame.
struct TargetUpdate {
  double mean_ratio = 0;  ///< mean likelihood ratio of its particles; 0 if none is inside the frame
  Peak estimate;          ///< weighted moments before resampling; mass 1, or 0 if mean_ratio is 0
};

/// One particle filter a target, all predicted and updated together: P-PHD (26), (31)-(35) without
/// births. Target t has the particles [t count, (t + 1) count). Each scan takes predict(),
/// update(), then resample().
class TargetFilters {
 public:
  /// `count` particles a target.
  TargetFilters(const MotionBank& bank, int count, const Device& device, std::uint64_t seed);
  /// Sets what targets look like; intensities are scaled so that each particle keeps its peak.
  void set_appearance(const TargetAppearance& appearance);

  std::size_t size() const { return particles_.size() / count_; }  ///< targets
  /// Adds a target, its particles drawn from the `members` of `from` in proportion to their weight.
  void add(const Particles& from, std::span<const std::uint32_t> members, std::int64_t frame);
  /// Adds a target whose particles are drawn about a cue; `speed_max` [px/frame].
  void add(const Cue& cue, const StepTime& at, double speed_max);
  /// Adds a copy of target `t` of other filters with the same number of particles a target.
  void add(const TargetFilters& other, std::size_t t);
  /// Removes target `t`; the later ones move up.
  void remove(std::size_t t);
  void clear() { particles_.resize(0); }
  /// Reverses all velocities: with a reversed bank predict() then steps into the past.
  void reverse_velocities();

  void predict(std::int64_t frame, double step);
  /// Weighs the particles by the frame `z`; one update a target, valid until the next call.
  std::span<const TargetUpdate> update(const Frame& z, std::int64_t frame);
  void resample(std::int64_t frame);

  const Particles& particles() const { return particles_; }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.appearance_, s.particles_);
  }
  void restored() const;

 private:
  RandomKey target_key(std::size_t t, std::int64_t frame, Purpose purpose) const;
  void weigh(std::size_t t);
  void redraw(std::size_t t, std::int64_t frame);

  MotionBank bank_;
  std::size_t count_;
  Device device_;
  std::uint64_t seed_;
  TargetAppearance appearance_;
  Particles particles_, moved_;
  AlignedVector<float> log_ratio_, drawn_from_;
  std::vector<std::uint32_t> indices_, ancestors_;
  std::vector<TargetUpdate> updates_;
  std::vector<ResampleWorkspace> draws_;  // by target
};

}  // namespace glint
