// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/pmht/pmht_em.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace glint {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();

}  // namespace

void pmht_gate(std::uint32_t target, const Eigen::Vector2d& expected, double gate,
               std::span<const Eigen::Vector2d> points, std::vector<PmhtPair>& pairs) {
  for (std::size_t j = 0; j < points.size(); ++j) {
    if ((points[j] - expected).cwiseAbs().maxCoeff() <= gate) {
      pairs.push_back({target, static_cast<std::uint32_t>(j)});
    }
  }
}

/// Scaled by each point's largest term, so that far points neither underflow nor divide by zero.
void pmht_posterior(std::span<const PmhtPair> pairs, std::span<const double> log_density,
                    const PmhtOrigins& origins, std::size_t points, std::vector<double>& sums,
                    std::span<double> posterior) {
  const double log_pi = std::log(origins.detection);
  const double log_clutter = origins.clutter > 0 ? std::log(origins.clutter) : kNever;
  sums.assign(2 * points, log_clutter);
  const auto largest = std::span(sums).first(points), sum = std::span(sums).last(points);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    double& most = largest[pairs[k].point];
    most = std::max(most, log_pi + log_density[k]);
  }
  for (std::size_t j = 0; j < points; ++j) {
    sum[j] = largest[j] > kNever ? std::exp(log_clutter - largest[j]) : 0;
  }
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const double most = largest[pairs[k].point];
    posterior[k] = most > kNever ? std::exp(log_pi + log_density[k] - most) : 0;
    sum[pairs[k].point] += posterior[k];
  }
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (posterior[k] > 0) posterior[k] /= sum[pairs[k].point];  // P-PMHT (16)
  }
}

void pmht_centroids(std::span<const PmhtPair> pairs, std::span<const double> posterior,
                    std::span<const Eigen::Vector2d> points, std::span<PmhtCentroid> centroids) {
  std::ranges::fill(centroids, PmhtCentroid{});
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    PmhtCentroid& centroid = centroids[pairs[k].target];
    centroid.weight += posterior[k];
    centroid.position += posterior[k] * points[pairs[k].point];
  }
  for (PmhtCentroid& centroid : centroids) {
    if (centroid.seen()) centroid.position /= centroid.weight;  // P-PMHT (23)
  }
}

int PmhtEm::run(const PmhtSettings& settings, std::span<const Eigen::Vector2d> points,
                std::span<const PmhtPair> pairs, std::size_t models,
                std::span<const PmhtMode> modes, Maximise maximise_mode) {
  settings_ = &settings, points_ = points, pairs_ = pairs, modes_ = modes, models_ = models;
  positions_.clear();
  for (const PmhtMode& mode : modes) positions_.push_back(mode.position);
  last_.assign(modes.size(), {});
  by_target_.resize(modes.size() / models);
  log_density_.resize(pairs.size()), share_.resize(pairs.size());
  for (int iteration = 1;; ++iteration) {
    posterior_.assign(pairs.size(), 0);
    if (settings.mixture) {
      expect_mixture();
    } else {
      for (std::size_t m = 0; m < models; ++m) expect(m);
    }
    if (iteration == 1) first_ = last_;
    if (maximise(maximise_mode) <= settings.tolerance || iteration >= settings.iterations) {
      return iteration;
    }
  }
}

/// Of the points about where `model` has each target now.
void PmhtEm::densities(std::size_t model, std::span<double> log_density) const {
  const double variance = settings_->variance;
  const double peak = -std::log(2 * std::numbers::pi * variance);
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const Eigen::Vector2d& at = positions_[pairs_[k].target * models_ + model];
    log_density[k] = peak - (points_[pairs_[k].point] - at).squaredNorm() / (2 * variance);
  }
}

void PmhtEm::centroids(std::size_t model) {
  pmht_centroids(pairs_, share_, points_, by_target_);
  for (std::size_t s = 0; s < by_target_.size(); ++s) last_[s * models_ + model] = by_target_[s];
}

void PmhtEm::expect(std::size_t model) {
  densities(model, log_density_);
  pmht_posterior(pairs_, log_density_, settings_->origins, points_.size(), sums_, share_);
  centroids(model);
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    posterior_[k] += modes_[pairs_[k].target * models_ + model].probability * share_[k];
  }
}

/// P-MMPF (8): all models of a target have the same centroid.
void PmhtEm::expect_mixture() {
  mixture_.resize(models_ * pairs_.size());
  for (std::size_t m = 0; m < models_; ++m) {
    densities(m, std::span(mixture_).subspan(m * pairs_.size(), pairs_.size()));
  }
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    double largest = kNever, sum = 0;
    for (std::size_t m = 0; m < models_; ++m) {
      double& term = mixture_[m * pairs_.size() + k];
      term += std::log(modes_[pairs_[k].target * models_ + m].probability);
      largest = std::max(largest, term);
    }
    for (std::size_t m = 0; m < models_; ++m) {
      sum += std::exp(mixture_[m * pairs_.size() + k] - largest);
    }
    log_density_[k] = largest + std::log(sum);
  }
  pmht_posterior(pairs_, log_density_, settings_->origins, points_.size(), sums_, share_);
  for (std::size_t m = 0; m < models_; ++m) centroids(m);
  std::ranges::copy(share_, posterior_.begin());
}

/// How far the position that moved most has moved [px].
double PmhtEm::maximise(Maximise step) {
  double furthest = 0;
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const Eigen::Vector2d at = last_[i].seen() ? step(i, last_[i]) : modes_[i].position;
    furthest = std::max(furthest, (at - positions_[i]).norm());
    positions_[i] = at;
  }
  return furthest;
}

}  // namespace glint
