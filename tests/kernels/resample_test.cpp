// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/resample/resample.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernels/special_floats.hpp"

namespace glint {
namespace {

struct Case {
  DeviceKind kind;
  Resampling method;
};

class ResampleOn : public testing::TestWithParam<Case> {
 protected:
  std::vector<std::uint32_t> draw(const std::vector<float>& weights, std::size_t count,
                                  std::uint64_t seed = 1) const {
    std::vector<std::uint32_t> ancestors(count);
    device_.run<Resample>({.weights = weights,
                           .ancestors = ancestors,
                           .method = GetParam().method,
                           .key = random_key(seed, 2, Purpose::resample)});
    return ancestors;
  }
  bool systematic() const { return GetParam().method == Resampling::systematic; }
  Device device_ = GetParam().kind == DeviceKind::serial ? Device::serial() : Device::tbb(2);
};
INSTANTIATE_TEST_SUITE_P(All, ResampleOn,
                         testing::Values(Case{DeviceKind::serial, Resampling::systematic},
                                         Case{DeviceKind::serial, Resampling::residual},
                                         Case{DeviceKind::tbb, Resampling::systematic},
                                         Case{DeviceKind::tbb, Resampling::residual}),
                         [](const auto& instance) {
                           return std::string(name(instance.param.kind)) +
                                  (instance.param.method == Resampling::systematic ? "Systematic"
                                                                                   : "Residual");
                         });

std::vector<float> random_weights(std::size_t n) {
  std::vector<float> weights(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    const float u = uniform(random_words(random_key(8, 0, Purpose::trial), i).w[0]);
    weights[i] = i % 7 == 3 ? 0.0f : -std::log(u);
  }
  return weights;
}

std::vector<int> counts_of(const std::vector<std::uint32_t>& ancestors, std::size_t particles) {
  std::vector<int> counts(particles, 0);
  for (const std::uint32_t a : ancestors) ++counts.at(a);
  return counts;
}

TEST_P(ResampleOn, CountsFollowTheWeights) {
  for (const auto& [particles, offspring] :
       {std::pair{9000, 9000}, {9000, 1000}, {700, 50000}, {5, 3}, {1, 1}}) {
    const auto weights = random_weights(static_cast<std::size_t>(particles));
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    const auto ancestors = draw(weights, static_cast<std::size_t>(offspring));
    EXPECT_TRUE(std::is_sorted(ancestors.begin(), ancestors.end()));
    const auto counts = counts_of(ancestors, weights.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double expected = offspring * weights[i] / total;
      if (weights[i] == 0) {
        ASSERT_EQ(counts[i], 0) << i;
      }
      ASSERT_GE(counts[i], std::floor(expected * (1 - 1e-6)) - (systematic() ? 1 : 0)) << i;
      if (systematic()) {
        ASSERT_LT(std::abs(counts[i] - expected), 1 + 1e-3) << i;
      }
    }
  }
}

TEST_P(ResampleOn, IsUnbiasedOverSeeds) {
  const std::vector<float> weights{0.05f, 0.4f, 0, 0.25f, 0.3f};
  std::vector<double> mean(weights.size(), 0);
  constexpr int kSeeds = 20000;
  for (int seed = 0; seed < kSeeds; ++seed) {
    for (const std::uint32_t a : draw(weights, 3, static_cast<std::uint64_t>(seed))) {
      mean[a] += 1.0 / kSeeds;
    }
  }
  for (std::size_t i = 0; i < weights.size(); ++i) {
    EXPECT_NEAR(mean[i], 3 * weights[i], 4.5 * 0.5 / std::sqrt(kSeeds)) << i;
  }
}

TEST_P(ResampleOn, EqualWeightsKeepEveryone) {
  for (const std::size_t n : {1u, 4096u, 10000u}) {
    std::vector<std::uint32_t> everyone(n);
    std::iota(everyone.begin(), everyone.end(), 0u);
    EXPECT_EQ(draw(std::vector<float>(n, 0.125f), n), everyone);
  }
}

TEST_P(ResampleOn, NoWeightAtAllCountsAsEqual) {
  std::vector<std::uint32_t> everyone(5000);
  std::iota(everyone.begin(), everyone.end(), 0u);
  EXPECT_EQ(draw(std::vector<float>(5000, 0.0f), 5000), everyone);
  EXPECT_EQ(draw(std::vector<float>(5000, kNan), 5000), everyone);
}

TEST_P(ResampleOn, NegativeAndNanWeightsHaveNoOffspring) {
  const auto ancestors = draw({-1, 2, kNan, 2, -kNan}, 100);
  EXPECT_EQ(counts_of(ancestors, 5), (std::vector<int>{0, 50, 0, 50, 0}));
}

TEST_P(ResampleOn, OneParticleMayTakeAll) {
  std::vector<float> weights(20000, 0.0f);
  weights[12345] = 1e-30f;
  EXPECT_EQ(draw(weights, 100001), std::vector<std::uint32_t>(100001, 12345));
}

TEST_P(ResampleOn, AHeavyParticleLeavesRoomForTheOthers) {
  std::vector<float> weights(20000, 1.0f);
  weights[7] = 60000;
  const auto counts = counts_of(draw(weights, 80000), weights.size());
  EXPECT_NEAR(counts[7], 60000, 2);
  EXPECT_LE(*std::max_element(counts.begin() + 8, counts.end()), 2);
}

TEST_P(ResampleOn, MovesArraysWithTheAncestors) {
  const auto weights = random_weights(9000);
  std::vector<float> x(9000), moved_x(7000);
  std::vector<std::uint32_t> label(9000), moved_label(7000), ancestors(7000);
  for (std::uint32_t i = 0; i < 9000; ++i) x[i] = static_cast<float>(i) + 0.25f, label[i] = ~i;
  const MovedArray moved[] = {{x.data(), moved_x.data()}, {label.data(), moved_label.data()}};
  device_.run<Resample>({.weights = weights,
                         .ancestors = ancestors,
                         .method = GetParam().method,
                         .key = {},
                         .moved = moved});
  for (std::size_t j = 0; j < 7000; ++j) {
    ASSERT_EQ(moved_x[j], x[ancestors[j]]);
    ASSERT_EQ(moved_label[j], label[ancestors[j]]);
  }
}

TEST_P(ResampleOn, OffspringNeedAParticle) {
  EXPECT_TRUE(draw({}, 0).empty());
  EXPECT_TRUE(draw({1, 2}, 0).empty());
  EXPECT_THROW(draw({}, 1), std::invalid_argument);
}

TEST_P(ResampleOn, ScalingAllWeightsByAPowerOfTwoChangesNothing) {
  auto weights = random_weights(5000);
  const auto ancestors = draw(weights, 5000);
  for (float& w : weights) w *= 0x1p-90f;
  EXPECT_EQ(draw(weights, 5000), ancestors);
}

TEST(Resample, DevicesAgreeExactly) {
  const auto weights = random_weights(30001);
  for (const Resampling method : {Resampling::systematic, Resampling::residual}) {
    for (const std::size_t count : {30001u, 999u, 70001u}) {
      std::vector<std::uint32_t> a(count), b(count);
      const RandomKey key = random_key(count, 1, Purpose::resample);
      Device::serial().run<Resample>(
          {.weights = weights, .ancestors = a, .method = method, .key = key});
      Device::tbb(3).run<Resample>(
          {.weights = weights, .ancestors = b, .method = method, .key = key});
      EXPECT_EQ(a, b);
    }
  }
}

}  // namespace
}  // namespace glint
