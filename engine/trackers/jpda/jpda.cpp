// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/jpda.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace glint {
namespace {

constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();
constexpr int kRounds = 50;               // to the mean number of points assigned
constexpr double kSettled = 1e-7;         // relative change of it
constexpr double kLargestExponent = 600;  // exp() of more is near the end of double

/// ln(K(d) (m/V)^d) = sum over k < d of ln(m / (m - k)), raised to powers of e that double holds.
void any_number(std::size_t points, std::size_t most, std::span<double> factor) {
  double log_factor = 0;
  const auto m = static_cast<double>(points);
  for (std::size_t d = 0; d <= most; ++d) {
    factor[d] = log_factor;
    if (d < most) log_factor += std::log(m / (m - static_cast<double>(d)));
  }
  const double shift = std::max(0.0, log_factor - kLargestExponent);
  for (double& f : factor) f = std::exp(f - shift);
}

}  // namespace

JpdaReport Jpda::run(std::span<const double> log_missed, std::span<const JpdaPair> pairs,
                     const JpdaClutter& clutter) {
  missed_.assign(log_missed.size(), 1), associated_.assign(pairs.size(), 0);
  find_clusters(pairs);
  JpdaReport report;
  report.clusters = ranges_.size();
  for (const Range& range : ranges_) report.largest = std::max(report.largest, range.targets);
  const auto solve_all = [&](double log_ratio) {
    report.approximate = 0;
    weigh(log_missed, pairs, log_ratio);
    factor_.assign(log_missed.size() + 1, 1);
    for (const Range& range : ranges_) solve(range, factor_, report);
  };
  const bool all_exact = std::ranges::all_of(ranges_, [&](const Range& r) { return exact(r); });
  const auto m = static_cast<double>(points_);
  if (clutter.number == JpdaClutter::Number::poisson) {
    solve_all(-std::log(clutter.density));
  } else if (all_exact) {
    weigh(log_missed, pairs, points_ > 0 ? std::log(clutter.volume / m) : 0);
    solve_any_number();
  } else {
    double assigned = 0, before = -1;
    for (int round = 0; round < kRounds && std::abs(assigned - before) > kSettled * m; ++round) {
      solve_all(std::log(clutter.volume / (m - assigned + 1)));
      before = assigned;
      assigned = std::accumulate(own_linked_.begin(), own_linked_.end(), 0.0);
    }
  }
  spread();
  return report;
}

/// Lays out the clusters by their first targets, in each the targets by number.
void Jpda::find_clusters(std::span<const JpdaPair> pairs) {
  const std::size_t targets = missed_.size();
  sets_.reset(targets);
  pair_begin_.assign(targets + 1, 0);
  std::uint32_t points = 0;
  for (const JpdaPair& pair : pairs) {
    points = std::max(points, pair.point + 1), ++pair_begin_[pair.target + 1];
  }
  std::partial_sum(pair_begin_.begin(), pair_begin_.end(), pair_begin_.begin());
  owner_.assign(points, kNobody), points_ = 0;
  for (const JpdaPair& pair : pairs) {
    if (owner_[pair.point] == kNobody) owner_[pair.point] = pair.target, ++points_;
    sets_.join(owner_[pair.point], pair.target);
  }
  order_.clear();
  for (std::uint32_t t = 0; t < targets; ++t) {
    if (pair_begin_[t] < pair_begin_[t + 1]) order_.push_back(t);
  }
  target_of_.assign(order_.begin(), order_.end());
  std::ranges::sort(target_of_, [this](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t x = sets_.root(a), y = sets_.root(b);
    return x != y ? x < y : a < b;
  });
  number_points(pairs);
}

void Jpda::number_points(std::span<const JpdaPair> pairs) {
  ranges_.clear(), links_.clear(), link_pair_.clear();
  local_.assign(owner_.size(), kNobody);
  for (std::size_t i = 0; i < target_of_.size(); ++i) {
    const std::uint32_t target = target_of_[i];
    if (i == 0 || sets_.root(target) != sets_.root(target_of_[i - 1])) {
      ranges_.push_back({i, 0, links_.size(), 0, 0});
    }
    Range& range = ranges_.back();
    for (std::size_t k = pair_begin_[target]; k < pair_begin_[target + 1]; ++k) {
      std::uint32_t& point = local_[pairs[k].point];
      if (point == kNobody) point = static_cast<std::uint32_t>(range.points++);
      links_.push_back({static_cast<std::uint32_t>(range.targets), point, 0});
      link_pair_.push_back(static_cast<std::uint32_t>(k));
    }
    ++range.targets, range.links = links_.size() - range.first_link;
  }
  weight_missed_.resize(target_of_.size());
  own_missed_.assign(target_of_.size(), 1), own_linked_.assign(links_.size(), 0);
}

/// Weights over that of the point as clutter, `log_ratio` being ln of the latter's inverse; a
/// target's sum to 1.
void Jpda::weigh(std::span<const double> log_missed, std::span<const JpdaPair> pairs,
                 double log_ratio) {
  std::size_t l = 0;
  for (std::size_t i = 0; i < target_of_.size(); ++i) {
    const std::uint32_t target = target_of_[i];
    const auto own =
        pairs.subspan(pair_begin_[target], pair_begin_[target + 1] - pair_begin_[target]);
    double largest = log_missed[target];
    for (const JpdaPair& pair : own) largest = std::max(largest, pair.log_weight + log_ratio);
    const auto scaled = [&](double log_weight) {
      return std::isfinite(largest) ? std::exp(log_weight - largest) : 0;
    };
    weight_missed_[i] = scaled(log_missed[target]);
    double sum = weight_missed_[i];
    for (std::size_t k = 0; k < own.size(); ++k) {
      links_[l + k].weight = scaled(own[k].log_weight + log_ratio);
      sum += links_[l + k].weight;
    }
    if (!(sum > 0)) weight_missed_[i] = sum = 1;
    weight_missed_[i] /= sum;
    for (std::size_t k = 0; k < own.size(); ++k) links_[l++].weight /= sum;
  }
}

JpdaCluster Jpda::cluster(const Range& range) const {
  return {std::span(weight_missed_).subspan(range.first_target, range.targets),
          std::span(links_).subspan(range.first_link, range.links), range.points};
}

bool Jpda::exact(const Range& range) const {
  return JpdaExact::table(range.targets, range.points) <= table_;
}

void Jpda::solve(const Range& range, std::span<const double> factor, JpdaReport& report) {
  const auto missed = std::span(own_missed_).subspan(range.first_target, range.targets);
  const auto linked = std::span(own_linked_).subspan(range.first_link, range.links);
  if (exact(range)) return exact_.marginals(cluster(range), factor, missed, linked);
  ++report.approximate;
  report.iterations = std::max(report.iterations, loopy_.marginals(cluster(range), missed, linked));
}

/// The further weight of d points assigned in a cluster is the sum over what the clusters before it
/// (`before_`) and after it (`after_`, which has K(d) in it) may have.
void Jpda::solve_any_number() {
  const auto degree = [](const Range& r) { return std::min(r.targets, r.points); };
  std::size_t most = 0;
  for (const Range& range : ranges_) most += degree(range);
  const std::size_t width = most + 1, clusters = ranges_.size();
  after_.assign((clusters + 1) * width, 0), polynomials_.clear();
  any_number(points_, most, std::span(after_).last(width));
  for (const Range& range : ranges_) {
    exact_.polynomial(cluster(range), polynomial_);
    polynomials_.insert(polynomials_.end(), polynomial_.begin(), polynomial_.end());
  }
  std::size_t end = polynomials_.size(), reach = most;
  for (std::size_t c = clusters; c-- > 0;) {
    const std::size_t d = degree(ranges_[c]);
    end -= d + 1, reach -= d;
    for (std::size_t t = 0; t <= reach; ++t) {
      for (std::size_t k = 0; k <= d; ++k) {
        after_[c * width + t] += polynomials_[end + k] * after_[(c + 1) * width + t + k];
      }
    }
  }
  before_.assign(1, 1);
  JpdaReport unused;
  for (std::size_t c = 0; c < clusters; ++c) {
    const std::size_t d = degree(ranges_[c]);
    factor_.assign(d + 1, 0), product_.assign(before_.size() + d, 0);
    for (std::size_t t = 0; t < before_.size(); ++t) {
      for (std::size_t k = 0; k <= d; ++k) {
        factor_[k] += before_[t] * after_[(c + 1) * width + t + k];
        product_[t + k] += before_[t] * polynomials_[end + k];
      }
    }
    end += d + 1;
    std::swap(before_, product_);
    solve(ranges_[c], factor_, unused);
  }
}

void Jpda::spread() {
  for (std::size_t i = 0; i < target_of_.size(); ++i) missed_[target_of_[i]] = own_missed_[i];
  for (std::size_t l = 0; l < links_.size(); ++l) associated_[link_pair_[l]] = own_linked_[l];
}

}  // namespace glint
