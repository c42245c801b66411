// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "glint/engine/filters/mode_probability.hpp"
#include "glint/engine/tracks/step_clock.hpp"
#include "glint/engine/tracks/track_log.hpp"
#include "glint/kernels/cell_weights/cell_weights.hpp"
#include "glint/kernels/core/particles.hpp"

namespace glint {

/// Weighted moments of a cluster of particles that stands for one target.
struct Peak : StateCovariance {
  double mass = 0;                      ///< expected number of targets
  double x = 0, y = 0, vx = 0, vy = 0;  ///< [px], [px/frame]; so the covariance's time is frames
  double intensity = 0;                 ///< [noise sigmas]
  ModeProbability mode_probability;     ///< of kMostModes models; sums to 1
  std::size_t first = 0, last = 0;      ///< members: PeakFinder::members()[first, last)

  // Without the members, which are valid for one frame only.
  template <class Self>
  static auto fields(Self& s) {
    return std::tuple_cat(std::tie(s.mass, s.x, s.y, s.vx, s.vy, s.intensity),
                          StateCovariance::fields(s), std::tie(s.mode_probability));
  }
};

/// A peak together with its particles.
struct Cluster {
  const Peak& peak;
  const Particles& particles;
  std::span<const std::uint32_t> members;  ///< indices of the peak's particles
};

/// A track point at `at` with the position, velocity and covariance of `estimate`; the caller sets
/// track, status and existence.
TrackPoint point_of(const Peak& estimate, std::size_t modes, const StepTime& at);

/// Weighted moments of `members`; `weight` is by particle, not by member. The mass must be
/// positive.
Peak describe_cluster(const Particles& particles, std::span<const std::uint32_t> members,
                      std::span<const float> weight);

/// Which clusters of particles are peaks.
struct PeakConfig {
  double threshold;  ///< least mass of a target
  double radius;     ///< half side of a cluster's box [px]
};

/// Finds targets in a set of particles: takes the window-sized box of the largest posterior mass,
/// moves it to the mean of its particles by mean shift, takes these particles out, and repeats
/// until no box reaches the threshold. (In place of k-means into round(n) classes, P-PHD
/// section 3.1, which fails as soon as n is off.)
class PeakFinder {
 public:
  /// Peaks by falling box mass. `runs` groups the particles by cell with their posterior mass;
  /// `particles.weight` is that posterior.
  std::span<const Peak> find(const Particles& particles, const CellRuns& runs, int width,
                             int height, int half_width, const PeakConfig& config);
  /// Particle indices of all peaks, peak after peak.
  std::span<const std::uint32_t> members() const { return members_; }
  std::span<const std::uint32_t> members(const Peak& peak) const {
    return std::span(members_).subspan(peak.first, peak.last - peak.first);
  }

 private:
  struct Candidate {
    float mass;  // of the window around the run's cell
    std::uint32_t run;
    bool operator<(const Candidate& o) const {
      return mass != o.mass ? mass < o.mass : run > o.run;  // of equal boxes the first
    }
  };
  template <class F>
  void for_runs_in(const CellRuns& runs, double x0, double y0, double x1, double y1, F&& f) const;
  double box_mass(const CellRuns& runs, std::uint32_t run, int half_width) const;
  void collect(const Particles& particles, const CellRuns& runs, double x, double y, double radius);
  bool take(const Particles& particles, const CellRuns& runs, std::uint32_t run,
            const PeakConfig& config);

  int width_ = 0, height_ = 0;
  // Mass that no peak has taken: in each run, in each run's window, of each particle.
  std::vector<float> mass_, box_, weight_;
  std::vector<Candidate> heap_;
  std::vector<std::uint32_t> members_;
  std::vector<Peak> peaks_;
};

}  // namespace glint
