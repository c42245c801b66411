// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/jpda_loopy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace glint {
namespace {

constexpr double kLeast = 1e-300;  // in place of nothing, where it divides
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

}  // namespace

int JpdaLoopy::marginals(const JpdaCluster& cluster, std::span<double> missed,
                         std::span<double> linked) {
  to_point_.resize(cluster.links.size());
  to_target_.assign(cluster.links.size(), 1);
  int iterations = 0;
  double change = 1;
  while (change > kTolerance && iterations < kIterations) {
    to_points(cluster);
    change = to_targets(cluster);
    ++iterations;
  }
  for (std::size_t l = 0, t = 0; t < missed.size(); ++t) {
    const std::size_t first = l;
    double sum = std::max(cluster.missed[t], kLeast);
    for (; l < cluster.links.size() && cluster.links[l].target == t; ++l) {
      linked[l] = cluster.links[l].weight * to_target_[l];
      sum += linked[l];
    }
    for (std::size_t k = first; k < l; ++k) linked[k] /= sum;
    missed[t] = std::max(cluster.missed[t], kLeast) / sum;
  }
  return iterations;
}

/// What a target says of a point: the weight of having it over that of having anything else. The
/// likeliest point is summed around, not subtracted: little may be left of the difference.
void JpdaLoopy::to_points(const JpdaCluster& cluster) {
  for (std::size_t l = 0, t = 0; t < cluster.missed.size(); ++t) {
    const std::size_t first = l;
    std::size_t likeliest = first;
    const auto term = [&](std::size_t k) { return cluster.links[k].weight * to_target_[k]; };
    for (; l < cluster.links.size() && cluster.links[l].target == t; ++l) {
      if (term(l) > term(likeliest)) likeliest = l;
    }
    double rest = cluster.missed[t];
    for (std::size_t k = first; k < l; ++k) rest += k == likeliest ? 0 : term(k);
    for (std::size_t k = first; k < l; ++k) {
      const double others = k == likeliest ? rest : rest - term(k) + term(likeliest);
      to_point_[k] = cluster.links[k].weight / std::max(others, kLeast);
    }
  }
}

/// What a point says to a target: the probability that no other target wants it. Returns the
/// largest change.
double JpdaLoopy::to_targets(const JpdaCluster& cluster) {
  strongest_.assign(cluster.points, kNone), rest_.assign(cluster.points, 1);
  for (std::size_t l = 0; l < cluster.links.size(); ++l) {
    std::size_t& strongest = strongest_[cluster.links[l].point];
    if (strongest == kNone || to_point_[l] > to_point_[strongest]) strongest = l;
  }
  for (std::size_t l = 0; l < cluster.links.size(); ++l) {
    const std::uint32_t point = cluster.links[l].point;
    if (strongest_[point] != l) rest_[point] += to_point_[l];
  }
  double change = 0;
  for (std::size_t l = 0; l < cluster.links.size(); ++l) {
    const std::uint32_t point = cluster.links[l].point;
    const std::size_t strongest = strongest_[point];
    const double others =
        strongest == l ? rest_[point] : rest_[point] - to_point_[l] + to_point_[strongest];
    const double message = 1 / others;
    change = std::max(change, std::abs(message - to_target_[l]));
    to_target_[l] = message;
  }
  return change;
}

}  // namespace glint
