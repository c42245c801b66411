// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "glint/engine/filters/imm.hpp"
#include "glint/engine/state/bytes.hpp"
#include "glint/engine/trackers/pmht/pmht_em.hpp"
#include "glint/kernels/core/random.hpp"
#include "glint/kernels/resample/resample.hpp"

namespace glint {

/// A target's motion models as P-MMPF moves them: a cloud of particles each, whose probabilities
/// are those of an IMM. P-MMPF section 2.
class ParticleBank {
 public:
  /// To be restored.
  ParticleBank() = default;
  /// Draws `particles` of each model from its belief in `imm`. `variance`: of a point's position
  /// along each axis [px^2]; `seed` and `track` are the address of all draws.
  ParticleBank(Imm imm, int particles, double variance, std::uint64_t seed, std::int64_t track);

  /// Models mix; those whose particles collapsed draw new ones; all move.
  void predict(double step);
  PmhtMode mode(std::size_t model) const;
  /// Mean of a model's particles as the centroid weighs them.
  Eigen::Vector2d maximise(std::size_t model, const PmhtCentroid& centroid) const;
  /// Takes the scan in: particles by the last centroids, one a model, probabilities by the first.
  void update(std::span<const PmhtCentroid> first, std::span<const PmhtCentroid> last);

  Gaussian<4> state() const { return imm_.combined(); }
  const ModeProbability& probability() const { return imm_.probability(); }
  /// Is made of the same models and numbers of particles.
  bool alike(const ParticleBank& other) const;

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.imm_, s.particles_, s.variance_, s.scan_, s.clouds_);
  }
  void restored();

 private:
  struct Cloud {
    Eigen::Vector2d origin = Eigen::Vector2d::Zero();  // that the positions count from
    std::vector<float> state;  // number by number of the model's state, each of all particles
    std::uint64_t seed = 0;    // of its draws
    bool collapsed = false;
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.origin, s.state, s.seed, s.collapsed);
    }
    void restored() const { require_bytes(origin.allFinite(), "particles are nowhere"); }
  };

  std::size_t size() const { return static_cast<std::size_t>(particles_); }
  RandomKey key(const Cloud& cloud, Purpose purpose) const;
  template <int N>
  void draw(Cloud& cloud, const Gaussian<N>& belief);
  Eigen::Vector2d origin_near(const Eigen::Vector2d& position) const;
  template <int N>
  void recentre(Cloud& cloud, const Gaussian<N>& belief) const;
  template <int N>
  void move(Cloud& cloud, const LinearMotion<N>& motion);
  template <int N>
  Gaussian<N> moments(const Cloud& cloud, std::span<const float> weights) const;
  template <int N>
  void distances(const Cloud& cloud, const Eigen::Vector2d& to) const;
  template <int N>
  void resample(Cloud& cloud);
  template <int N>
  void take_in(Cloud& cloud, Gaussian<N>& belief, const PmhtCentroid& centroid);
  double weigh() const;

  Imm imm_;  // its beliefs are the clouds' moments
  int particles_ = 0;
  double variance_ = 1;
  std::uint32_t scan_ = 0;  // counted from the start
  std::vector<Cloud> clouds_;
  // Memory to be used again.
  mutable std::vector<float> weights_;
  std::vector<float> moved_;
  std::vector<std::uint32_t> ancestors_;
};

}  // namespace glint
