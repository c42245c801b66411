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

/// A cluster of particles that stands for one target: weighted moments of its members.
struct Peak {
  double mass = 0;  ///< expected number of targets
  double x = 0, y = 0, vx = 0, vy = 0, intensity = 0;
  double var_x = 0, cov_xy = 0, var_y = 0;  ///< [px^2]
  ModeProbability mode_probability;         ///< of kMostModes models; sums to 1
  std::size_t first = 0, last = 0;          ///< members: PeakFinder::members()[first, last)

  // But for the members, who are those of one frame.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.mass, s.x, s.y, s.vx, s.vy, s.intensity, s.var_x, s.cov_xy, s.var_y,
                    s.mode_probability);
  }
};

/// A track point of `estimate`, whose velocity is in px a frame, at that time; track, status and
/// existence are the caller's to set.
TrackPoint point_of(const Peak& estimate, std::size_t modes, const StepTime& at);

/// Weighted moments of `members`; `weight` is by particle, not by member. The mass must be
/// positive.
Peak describe_cluster(const Particles& particles, std::span<const std::uint32_t> members,
                      std::span<const float> weight);

struct PeakConfig {
  double threshold = 0.5;  ///< least mass of a target
  double radius = 2.5;     ///< half side of a cluster's box [px]
  int shifts = 3;          ///< mean shifts
};

/// Finds targets in a particle cloud: takes the window-sized box of the largest posterior mass,
/// shifts it to the mean of its particles, takes these particles away, and repeats until no box
/// holds the threshold. (In place of round(n) and k-means in P-PHD section 3.1, which breaks as
/// soon as n is off.)
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
    float mass;
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
  std::vector<float> mass_, box_, weight_;  // left over: per run, per box, per particle
  std::vector<Candidate> heap_;
  std::vector<std::uint32_t> members_;
  std::vector<Peak> peaks_;
};

}  // namespace glint
