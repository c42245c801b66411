// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "glint/engine/frames/target_appearance.hpp"
#include "glint/engine/trackers/phd/motion_bank.hpp"
#include "glint/engine/trackers/phd/peaks.hpp"
#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/particles.hpp"
#include "glint/kernels/core/random.hpp"
#include "glint/kernels/resample/resample.hpp"

namespace glint {

/// What one frame says of a target.
struct TargetUpdate {
  double mean_ratio = 0;  ///< likelihood ratio, mean over the cloud; 0 if no particle is in view
  Peak estimate;          ///< weighted moments before resampling; mass 1, or 0 if mean_ratio is 0
};

/// A particle filter of one known target each, all of them moved and weighed together: P-PHD (26),
/// (31)-(35) without births. Target t holds particles [t count, (t + 1) count). A scan is
/// predict(), update(), resample().
class TargetFilters {
 public:
  /// `count` particles a target.
  TargetFilters(const MotionBank& bank, int count, const Device& device, std::uint64_t seed);
  void set_appearance(const TargetAppearance& appearance);

  std::size_t size() const { return particles_.size() / count_; }  ///< targets
  /// One more target, drawn from those particles in proportion to their weight.
  void add(const Particles& from, std::span<const std::uint32_t> members, std::int64_t frame);
  /// One more target: a copy of target `t` of other clouds of the same count.
  void add(const TargetFilters& other, std::size_t t);
  /// Takes target `t` away; the later ones move up.
  void remove(std::size_t t);
  void clear() { particles_.resize(0); }
  /// Turns time round: velocities point backwards. With a reversed bank predict() then steps into
  /// the past.
  void reverse_velocities();

  void predict(std::int64_t frame, double step);
  /// Weighs all clouds by the frame `z`; the result is by target.
  std::span<const TargetUpdate> update(const Frame& z, std::int64_t frame);
  void resample(std::int64_t frame);

  const Particles& particles() const { return particles_; }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.appearance_, s.particles_);
  }
  void restored() const;

 private:
  RandomKey cloud_key(std::size_t t, std::int64_t frame, Purpose purpose) const;
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
