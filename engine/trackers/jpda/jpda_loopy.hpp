// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "glint/engine/trackers/jpda/jpda_cluster.hpp"

namespace glint {

/// Marginals of a cluster's joint events by loopy belief propagation between targets and points,
/// Poisson clutter (Williams and Lau 2014, who prove that it converges). Exact where no cycle of
/// targets shares points; else probabilities lean to the likelier.
class JpdaLoopy {
 public:
  static constexpr int kIterations = 1000;
  static constexpr double kTolerance = 1e-10;  ///< of a message, which lies in [0, 1]

  /// Probabilities of no point, by target, and of each link. Returns the number of iterations.
  int marginals(const JpdaCluster& cluster, std::span<double> missed, std::span<double> linked);

 private:
  void to_points(const JpdaCluster& cluster);
  double to_targets(const JpdaCluster& cluster);

  std::vector<double> to_point_, to_target_;  // messages, by link
  std::vector<std::size_t> strongest_;        // of the messages to a point, its link
  std::vector<double> rest_;                  // their sum without the strongest
};

}  // namespace glint
