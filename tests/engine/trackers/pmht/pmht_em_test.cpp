// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "glint/engine/trackers/pmht/pmht_em.hpp"

namespace glint {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr double kPointVariance = 4;
constexpr PmhtOrigins kOrigins{0.9, 2e-3};

double density(const Eigen::Vector2d& point, const Eigen::Vector2d& at) {
  return std::exp(-(point - at).squaredNorm() / (2 * kPointVariance)) /
         (2 * std::numbers::pi * kPointVariance);
}

Points targets() { return {{10, 10}, {13, 11}, {8, 14}}; }
Points points() { return {{11, 10}, {12.5, 11.5}, {9, 13}, {20, 4}}; }

std::vector<PmhtPair> all_pairs(std::size_t targets, std::size_t points) {
  std::vector<PmhtPair> pairs;
  for (std::uint32_t s = 0; s < targets; ++s) {
    for (std::uint32_t j = 0; j < points; ++j) pairs.push_back({s, j});
  }
  return pairs;
}

std::vector<double> posterior(const Points& at, const Points& y, const PmhtOrigins& origins) {
  const auto pairs = all_pairs(at.size(), y.size());
  std::vector<double> log_density, sums, z(pairs.size());
  for (const PmhtPair& p : pairs)
    log_density.push_back(std::log(density(y[p.point], at[p.target])));
  pmht_posterior(pairs, log_density, origins, y.size(), sums, z);
  return z;
}

/// P-PMHT (7), (13): every assignment of the points to a target or to clutter, written out.
std::vector<double> enumerated(const Points& at, const Points& y) {
  const std::size_t classes = at.size() + 1;
  std::vector<double> z(at.size() * y.size());
  double all = 0;
  const auto assignments = static_cast<std::size_t>(std::pow(classes, y.size()));
  for (std::size_t code = 0; code < assignments; ++code) {
    double joint = 1;
    std::size_t rest = code;
    for (std::size_t j = 0; j < y.size(); ++j, rest /= classes) {
      const std::size_t s = rest % classes;
      joint *= s == at.size() ? kOrigins.clutter : kOrigins.detection * density(y[j], at[s]);
    }
    all += joint;
    rest = code;
    for (std::size_t j = 0; j < y.size(); ++j, rest /= classes) {
      if (rest % classes < at.size()) z[rest % classes * y.size() + j] += joint;
    }
  }
  for (double& value : z) value /= all;
  return z;
}

TEST(PmhtEStep, IsBayesRuleOverAllAssignments) {
  const auto z = posterior(targets(), points(), kOrigins), truth = enumerated(targets(), points());
  for (std::size_t k = 0; k < z.size(); ++k) EXPECT_NEAR(z[k], truth[k], 1e-13) << k;
}

TEST(PmhtEStep, SharesOfAPointSumToOneWithThatOfClutter) {
  const auto z = posterior(targets(), points(), kOrigins);
  for (std::size_t j = 0; j < 4; ++j) {
    double all = kOrigins.clutter, sum = z[j] + z[4 + j] + z[8 + j];
    for (const auto& at : targets()) all += kOrigins.detection * density(points()[j], at);
    EXPECT_NEAR(sum + kOrigins.clutter / all, 1, 1e-14);
    EXPECT_LT(sum, 1);
  }
}

TEST(PmhtEStep, WithoutClutterEveryPointIsATargetsHoweverFar) {
  const auto z = posterior({{0, 0}, {40, 0}}, {{30, 30}, {1, 0}}, {0.9, 0});
  EXPECT_NEAR(z[0] + z[2], 1, 1e-14);
  const std::array<double, 2> far{-1e6, -1e6 - std::log(3)};
  std::array<double, 2> shares{};
  std::vector<double> sums;
  pmht_posterior(all_pairs(2, 1), far, {0.9, 0}, 1, sums, shares);
  EXPECT_NEAR(shares[0], 0.75, 1e-9);
  EXPECT_NEAR(shares[1], 0.25, 1e-9);
}

TEST(PmhtEStep, RelabelledTargetsAndPointsKeepTheirShares) {
  const Points at = targets(), y = points();
  const std::array<std::size_t, 3> s_of{2, 0, 1};
  const std::array<std::size_t, 4> j_of{3, 1, 0, 2};
  Points at2, y2;
  for (const std::size_t s : s_of) at2.push_back(at[s]);
  for (const std::size_t j : j_of) y2.push_back(y[j]);
  const auto z = posterior(at, y, kOrigins), z2 = posterior(at2, y2, kOrigins);
  for (std::size_t s = 0; s < 3; ++s) {
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_NEAR(z2[s * 4 + j], z[s_of[s] * 4 + j_of[j]], 1e-15);
    }
  }
}

TEST(PmhtEStep, GateIsASquareWithItsBorder) {
  std::vector<PmhtPair> pairs;
  pmht_gate(7, {10, 10}, 2, Points{{12, 8}, {12.1, 10}, {10, 7.9}, {9, 11}}, pairs);
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].target, 7u);
  EXPECT_EQ(pairs[0].point, 0u);
  EXPECT_EQ(pairs[1].point, 3u);
}

Gaussian<4> predicted(const Eigen::Vector2d& at) {
  Gaussian<4> state;
  state.mean << at.x(), 1, at.y(), -2;
  Eigen::Matrix4d root;
  root << 2, 0, 0, 0, .5, 1, 0, 0, .3, -.2, 1.5, 0, .1, .4, .6, .8;
  state.covariance = root * root.transpose();
  return state;
}

Eigen::Matrix<double, 2, 4> measured() {
  Eigen::Matrix<double, 2, 4> h = Eigen::Matrix<double, 2, 4>::Zero();
  h(0, 0) = h(1, 2) = 1;
  return h;
}

TEST(PmhtMStep, IsTheMaximumOverAllPointsByTheirShares) {
  const Points y = points();
  const std::array<double, 4> z{0.7, 0.2, 0.4, 0.05};
  std::array<PmhtCentroid, 1> centroid;
  pmht_centroids(all_pairs(1, 4), z, y, centroid);
  EXPECT_NEAR(centroid[0].weight, 1.35, 1e-15);
  // (17) with (15) and (A.9), solved in information form, point by point.
  const Gaussian<4> prior = predicted({10, 10});
  Eigen::Matrix4d information = prior.covariance.inverse();
  Eigen::Vector4d weighted = information * prior.mean;
  for (std::size_t j = 0; j < y.size(); ++j) {
    information += z[j] / kPointVariance * measured().transpose() * measured();
    weighted += z[j] / kPointVariance * measured().transpose() * y[j];
  }
  const Gaussian<4> updated = pmht_update(prior, centroid[0], kPointVariance);
  EXPECT_LT((updated.mean - information.inverse() * weighted).norm(), 1e-11);
  EXPECT_LT((updated.covariance - information.inverse()).norm(), 1e-11);
}

TEST(PmhtMStep, LikelihoodOfAModelIsThatOfItsCentroidTimesItsPoints) {
  const Gaussian<4> prior = predicted({10, 10});
  const PmhtCentroid centroid{0.5, {12, 9}};
  const Eigen::Matrix2d s = measured() * prior.covariance * measured().transpose() +
                            kPointVariance / 0.5 * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d v(2, -1);
  const double density =
      std::exp(-v.dot(s.inverse() * v) / 2) / (2 * std::numbers::pi * std::sqrt(s.determinant()));
  EXPECT_NEAR(pmht_log_likelihood(prior, centroid, kPointVariance), std::log(0.5 * density), 1e-12);
}

TEST(PmhtMStep, WithoutPointsThePredictionStays) {
  const Gaussian<4> prior = predicted({10, 10});
  EXPECT_EQ(pmht_update(prior, {}, kPointVariance).mean, prior.mean);
  EXPECT_EQ(pmht_update(prior, {}, kPointVariance).covariance, prior.covariance);
  EXPECT_LT(pmht_log_likelihood(prior, {}, kPointVariance),
            pmht_log_likelihood(prior, {1, {20, 20}}, kPointVariance));
}

/// Two targets, each with one model or two.
struct Problem {
  std::vector<Gaussian<4>> priors;
  std::vector<PmhtMode> modes;
  std::size_t models;
  PmhtSettings settings{.origins = kOrigins,
                        .variance = kPointVariance,
                        .mixture = false,
                        .iterations = 50,
                        .tolerance = 1e-3};
  PmhtEm em{};
  std::vector<PmhtPair> pairs{};

  Problem(const Points& at, std::vector<double> probability, std::size_t models_of_each)
      : models(models_of_each) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      priors.push_back(predicted(at[i]));
      modes.push_back({at[i], probability[i]});
    }
    pairs = all_pairs(at.size() / models, points().size());
  }
  Points run() {
    const Points y = points();
    Points at;
    em.run(settings, y, pairs, models, modes,
           [&](std::size_t mode, const PmhtCentroid& c) -> Eigen::Vector2d {
             return measured() * pmht_update(priors[mode], c, kPointVariance).mean;
           });
    for (std::size_t i = 0; i < modes.size(); ++i) {
      at.emplace_back(measured() * pmht_update(priors[i], em.last()[i], kPointVariance).mean);
    }
    return at;
  }
};

/// What EM climbs: log of the points' density and of the states' prior, (12), (18), with states
/// that are best given their positions.
double objective(const Points& at, const std::vector<Gaussian<4>>& priors) {
  double sum = 0;
  for (const auto& y : points()) {
    double p = kOrigins.clutter;
    for (const auto& x : at) p += kOrigins.detection * density(y, x);
    sum += std::log(p);
  }
  for (std::size_t s = 0; s < at.size(); ++s) {
    const Eigen::Matrix2d b = measured() * priors[s].covariance * measured().transpose();
    const Eigen::Vector2d off = at[s] - measured() * priors[s].mean;
    sum -= off.dot(b.inverse() * off) / 2;
  }
  return sum;
}

TEST(PmhtEm, NeverDescendsAndEndsAtAFixedPoint) {
  double last = -1e300;
  for (int iterations = 1; iterations <= 12; ++iterations) {
    Problem problem({{10, 10}, {13, 12}}, {1, 1}, 1);
    problem.settings.iterations = iterations, problem.settings.tolerance = 0;
    const double now = objective(problem.run(), problem.priors);
    EXPECT_GE(now, last - 1e-12) << iterations;
    last = now;
  }
  Problem problem({{10, 10}, {13, 12}}, {1, 1}, 1);
  problem.settings.tolerance = 1e-12, problem.settings.iterations = 1000;
  const Points at = problem.run();
  EXPECT_GE(objective(at, problem.priors), last);
  const auto z = posterior(at, points(), kOrigins);
  for (std::size_t k = 0; k < z.size(); ++k) EXPECT_NEAR(problem.em.posterior()[k], z[k], 1e-9);
}

TEST(PmhtEm, ModelsCompeteWithTheSameModelOfOtherTargets) {
  Problem problem({{10, 10}, {9, 9}, {13, 12}, {14, 11}}, {.7, .3, .4, .6}, 2);
  problem.settings.iterations = 1;
  problem.run();
  const std::array z{posterior({{10, 10}, {13, 12}}, points(), kOrigins),
                     posterior({{9, 9}, {14, 11}}, points(), kOrigins)};
  for (std::size_t s = 0; s < 2; ++s) {
    for (std::size_t m = 0; m < 2; ++m) {
      double weight = 0;
      for (std::size_t j = 0; j < 4; ++j) weight += z[m][s * 4 + j];
      EXPECT_NEAR(problem.em.first()[s * 2 + m].weight, weight, 1e-13);
    }
    const double p = problem.modes[s * 2].probability;
    EXPECT_NEAR(problem.em.posterior()[s * 4], p * z[0][s * 4] + (1 - p) * z[1][s * 4], 1e-13);
  }
}

TEST(PmhtEm, AMixtureHasOneCentroidForAllModelsOfATarget) {
  Problem problem({{10, 10}, {9, 9}, {13, 12}, {14, 11}}, {.7, .3, .4, .6}, 2);
  problem.settings.mixture = true, problem.settings.iterations = 1;
  problem.run();
  for (std::size_t s = 0; s < 2; ++s) {
    double weight = 0;
    for (std::size_t j = 0; j < 4; ++j) {
      const auto p = [&](std::size_t target) {
        const PmhtMode &a = problem.modes[target * 2], &b = problem.modes[target * 2 + 1];
        return a.probability * density(points()[j], a.position) +
               b.probability * density(points()[j], b.position);
      };
      weight += .9 * p(s) / (kOrigins.clutter + .9 * p(0) + .9 * p(1));  // P-MMPF (8)
    }
    EXPECT_NEAR(problem.em.first()[s * 2].weight, weight, 1e-13);
    EXPECT_EQ(problem.em.first()[s * 2].weight, problem.em.first()[s * 2 + 1].weight);
    EXPECT_EQ(problem.em.first()[s * 2].position, problem.em.first()[s * 2 + 1].position);
  }
}

TEST(PmhtEm, WithoutPointsEveryModeStaysWhereItIs) {
  PmhtEm em;
  const std::vector<PmhtMode> modes{{{1, 2}, 1}, {{3, 4}, 1}};
  const int iterations = em.run({}, {}, {}, 1, modes, [](std::size_t, const PmhtCentroid&) {
    return Eigen::Vector2d(99, 99);
  });
  EXPECT_EQ(iterations, 1);
  EXPECT_FALSE(em.last()[0].seen());
  EXPECT_FALSE(em.last()[1].seen());
}

}  // namespace
}  // namespace glint
