// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "glint/engine/trackers/jpda/jpda.hpp"

// JPDA by the sum over all events, and cases to try it on.
namespace glint::test {

using Number = JpdaClutter::Number;

struct Case {
  std::vector<double> log_missed;
  std::vector<JpdaPair> pairs;
  JpdaClutter clutter;
};

/// `share`: of the pairs of targets and points that may be; `spread`: of log weights.
inline Case random_case(std::mt19937& random, std::uint32_t targets, std::uint32_t points,
                        double share, double spread) {
  std::uniform_real_distribution<double> uniform;
  Case c;
  for (std::uint32_t t = 0; t < targets; ++t) {
    c.log_missed.push_back(std::log(uniform(random) * 0.5 + 0.001));
    for (std::uint32_t p = 0; p < points; ++p) {
      if (uniform(random) < share) c.pairs.push_back({t, p, spread * (uniform(random) - 0.7)});
    }
  }
  c.clutter.density = std::exp(4 * (uniform(random) - 0.7));
  c.clutter.volume = std::exp(4 * uniform(random));
  return c;
}

struct Marginals {
  std::vector<double> missed, associated;
};

/// Every event, one after another. P-JPDA (12), (13).
class Enumeration {
 public:
  explicit Enumeration(const Case& c) : case_(c) {
    for (const JpdaPair& pair : c.pairs) points_.insert(pair.point);
    sums_.missed.assign(c.log_missed.size(), 0), sums_.associated.assign(c.pairs.size(), 0);
    choose(0, 1, 0);
    for (double& p : sums_.missed) p /= all_;
    for (double& p : sums_.associated) p /= all_;
  }
  const Marginals& marginals() const { return sums_; }

 private:
  double clutter(std::size_t assigned) const {
    const auto m = static_cast<double>(points_.size()), d = static_cast<double>(assigned);
    if (case_.clutter.number == Number::poisson) return std::pow(case_.clutter.density, m - d);
    return std::tgamma(m - d + 1) / std::tgamma(m + 1) * std::pow(case_.clutter.volume, d - m);
  }
  void choose(std::uint32_t target, double weight, std::size_t assigned) {
    if (target == case_.log_missed.size()) {
      weight *= clutter(assigned);
      all_ += weight;
      std::size_t t = 0;
      for (const std::size_t k : chosen_) {
        (k == kNone ? sums_.missed[t] : sums_.associated[k]) += weight, ++t;
      }
      return;
    }
    chosen_.push_back(kNone);
    choose(target + 1, weight * std::exp(case_.log_missed[target]), assigned);
    for (std::size_t k = 0; k < case_.pairs.size(); ++k) {
      const JpdaPair& pair = case_.pairs[k];
      if (pair.target != target || used_.contains(pair.point)) continue;
      used_.insert(pair.point), chosen_.back() = k;
      choose(target + 1, weight * std::exp(pair.log_weight), assigned + 1);
      used_.erase(pair.point);
    }
    chosen_.pop_back();
  }

  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  const Case& case_;
  std::set<std::uint32_t> points_, used_;
  std::vector<std::size_t> chosen_;
  Marginals sums_;
  double all_ = 0;
};

inline Marginals marginals_of(const Case& c, Jpda& jpda) {
  jpda.run(c.log_missed, c.pairs, c.clutter);
  return {{jpda.missed().begin(), jpda.missed().end()},
          {jpda.associated().begin(), jpda.associated().end()}};
}

inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = std::abs(a[i] - b[i]);
    largest = difference <= largest ? largest : difference;  // NaN counts
  }
  return largest;
}
inline double largest_difference(const Marginals& a, const Marginals& b) {
  return std::max(largest_difference(a.missed, b.missed),
                  largest_difference(a.associated, b.associated));
}

}  // namespace glint::test
