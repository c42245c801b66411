// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/metrics/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "glint/engine/metrics/assignment.hpp"

namespace glint {
namespace {

double distance(const Position& a, const Position& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// NaN counts as out of reach.
double capped(double distance, double cutoff) { return distance <= cutoff ? distance : cutoff; }

void check(double cutoff, double order) {
  if (!(cutoff > 0)) throw std::invalid_argument("cutoff must be above 0 px");
  if (!(order >= 1)) throw std::invalid_argument("order must be at least 1");
}

/// Pairs of the assignment of least capped cost, those beyond the cut-off included.
std::vector<Match> assign(std::span<const Position> truth, std::span<const Position> estimates,
                          double cutoff, double order) {
  check(cutoff, order);
  Eigen::MatrixXd costs(truth.size(), estimates.size());
  for (Eigen::Index i = 0; i < costs.rows(); ++i) {
    for (Eigen::Index j = 0; j < costs.cols(); ++j) {
      const Position& a = truth[static_cast<std::size_t>(i)];
      const Position& b = estimates[static_cast<std::size_t>(j)];
      costs(i, j) = std::pow(capped(distance(a, b), cutoff), order);
    }
  }
  const std::vector<int> partner = assign_least_cost(costs);
  std::vector<Match> pairs;
  for (std::size_t i = 0; i < partner.size(); ++i) {
    if (partner[i] < 0) continue;
    const Position& estimate = estimates[static_cast<std::size_t>(partner[i])];
    pairs.push_back({static_cast<int>(i), partner[i], distance(truth[i], estimate)});
  }
  return pairs;
}

}  // namespace

Ospa ospa(std::span<const Position> truth, std::span<const Position> estimates, double cutoff,
          double order) {
  const auto larger = static_cast<double>(std::max(truth.size(), estimates.size()));
  double near = 0;
  const std::vector<Match> pairs = assign(truth, estimates, cutoff, order);
  for (const Match& pair : pairs) near += std::pow(capped(pair.distance, cutoff), order);
  if (larger == 0) return {};
  const double far = std::pow(cutoff, order) * (larger - static_cast<double>(pairs.size()));
  const auto root = [&](double sum) { return std::pow(sum / larger, 1 / order); };
  return {root(near + far), root(near), root(far)};
}

Gospa gospa(std::span<const Position> truth, std::span<const Position> estimates, double cutoff,
            double order) {
  const std::vector<Match> pairs = match(truth, estimates, cutoff, order);
  const double each = std::pow(cutoff, order) / 2;
  const double missed = each * static_cast<double>(truth.size() - pairs.size());
  const double extra = each * static_cast<double>(estimates.size() - pairs.size());
  double near = 0;
  for (const Match& pair : pairs) near += std::pow(pair.distance, order);
  const auto root = [&](double sum) { return std::pow(sum, 1 / order); };
  return {root(near + missed + extra), root(near), root(missed), root(extra)};
}

std::vector<Match> match(std::span<const Position> truth, std::span<const Position> estimates,
                         double cutoff, double order) {
  std::vector<Match> pairs = assign(truth, estimates, cutoff, order);
  std::erase_if(pairs, [cutoff](const Match& pair) { return !(pair.distance <= cutoff); });
  return pairs;
}

}  // namespace glint
