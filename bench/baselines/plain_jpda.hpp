// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <span>
#include <vector>

#include "glint/bench/baselines/plain_imm.hpp"
#include "glint/bench/baselines/plain_jpda_events.hpp"
#include "glint/engine/trackers/jpda/imm_jpda.hpp"

namespace glint::bench {

/// The trackers `imm-jpda` and `imm-mscan-jpda` for known targets: every joint event of a cluster
/// is written down with its weight, one after another, for each joint event of the scan before.
/// Positions, Poisson clutter, a window of 1 scan, or of 2 with the best permutations.
class PlainJpda {
 public:
  explicit PlainJpda(const ImmJpdaConfig& config) : config_(config) {}
  /// A target at (x, y) [px] with velocity (vx, vy) [px/frame] one frame before the first scan.
  void start(double x, double y, double vx, double vy);
  void step(std::span<const PointMeasurement> points);
  std::vector<Eigen::Vector4d> states() const;  ///< [x vx y vy], in the order of start()

 private:
  using Event = PlainEvent;
  using Events = PlainEvents;
  struct Group {
    std::vector<int> targets;
    Events events;
  };
  struct Target {
    PlainBank estimate;
    std::vector<PlainBank> hypotheses;
    std::vector<int> gate;                      // numbers of points
    std::vector<std::vector<PlainBank>> child;  // by hypothesis and option: 0, or point of gate + 1
    std::vector<std::vector<double>> weight, posterior;
  };
  using Joint = std::map<Event, std::map<Event, double>>;  // by options, then by event before

  void predict(Target& target) const;
  void update(Target& target, std::size_t hypothesis) const;
  std::vector<std::vector<int>> clusters() const;
  Group gather(const std::vector<int>& cluster) const;
  Joint enumerate(const Group& before) const;
  void choose(const Group& before, Event& options, std::vector<int>& used, Joint& joint) const;
  void keep_best_permutations(const Group& before, Joint& joint) const;
  void add_posterior(const Group& before, const Joint& joint);
  void estimate(Target& target) const;
  void advance(const Group& before, const Joint& joint, std::vector<Group>& next) const;
  void take_over(Group& group);

  ImmJpdaConfig config_;
  std::vector<Target> targets_;
  std::vector<Group> groups_;
  std::vector<Eigen::VectorXd> points_;
};

}  // namespace glint::bench
