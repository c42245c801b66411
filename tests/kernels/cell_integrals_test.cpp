// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/cell_integrals/cell_integrals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

/// Exponential noise, as intensities of a histogram.
Image<float> noise_image(int width, int height) {
  Image<float> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto item = static_cast<std::uint32_t>(y * width + x);
      const Words4 words = random_words(random_key(9, 0, Purpose::trial), item);
      image.view()(x, y) = -std::log(uniform(words.w[0]));
    }
  }
  return image;
}

struct Result {
  std::vector<TargetSums> sums;
  MixtureSums mixture;
};

Result integrate(const Device& device, CellIntegrals::Args args,
                 const std::vector<HistogramTarget>& targets) {
  Result result;
  result.sums.resize(targets.size());
  device.run<SumCells>({args.frame, args.rule, &args.total});
  args.targets = targets, args.sums = result.sums;
  args.mixture = &result.mixture, args.log_likelihood = true;
  device.run<CellIntegrals>(args);
  return result;
}

double normal(double u, double sigma) {
  return std::exp(-0.5 * u * u / (sigma * sigma)) / (sigma * std::sqrt(2 * std::numbers::pi));
}

/// Integral of u^n N(u; 0, sigma^2) over [a, b] by the midpoint rule.
double moment(int n, double a, double b, double sigma) {
  constexpr int kSteps = 2000;
  const double step = (b - a) / kSteps;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double u = a + (i + 0.5) * step;
    sum += std::pow(u, n) * normal(u, sigma) * step;
  }
  return sum;
}

struct Columns {
  std::vector<double> p, first, second;

  Columns(double mean, double sigma, int length) {
    for (int i = 0; i < length; ++i) {
      const double a = i - 0.5 - mean, b = i + 0.5 - mean;
      p.push_back(moment(0, a, b, sigma));
      first.push_back(moment(1, a, b, sigma));
      second.push_back(moment(2, a, b, sigma));
    }
  }
};

/// P-HPMHT (6)-(11), (17), (18) as printed, over the whole frame, cell integrals by quadrature.
Result by_quadrature(const CellIntegrals::Args& args, const std::vector<HistogramTarget>& targets) {
  const FrameView frame = args.frame;
  const double flat = args.background / (static_cast<double>(frame.width) * frame.height);
  std::vector<Columns> columns, rows;
  for (const HistogramTarget& t : targets) {
    columns.emplace_back(t.x, t.sigma_x, frame.width);
    rows.emplace_back(t.y, t.sigma_y, frame.height);
  }
  const auto missing = [&](int x, int y) {
    return (args.rule.truncate_dark && !(frame(x, y) > args.rule.threshold)) ||
           std::any_of(args.rule.missing.begin(), args.rule.missing.end(),
                       [&](const Box& b) { return b.contains(x, y); });
  };
  const auto intensity = [&](int x, int y) {
    const double z = frame(x, y), threshold = args.rule.threshold;
    return z > threshold ? z - (args.rule.subtract ? threshold : 0) : 0;
  };
  const auto mixture = [&](std::size_t x, std::size_t y) {
    double p = flat;
    for (std::size_t k = 0; k < targets.size(); ++k) {
      p += targets[k].proportion * columns[k].p[x] * rows[k].p[y];
    }
    return p;
  };
  Result r;
  double norm = 0;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      if (missing(x, y)) continue;
      const double p = mixture(static_cast<std::size_t>(x), static_cast<std::size_t>(y));
      norm += intensity(x, y);
      r.mixture.shown += p;
      r.mixture.log_likelihood += intensity(x, y) * std::log(p);
    }
  }
  r.sums.resize(targets.size());
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const auto i = static_cast<std::size_t>(x), j = static_cast<std::size_t>(y);
      const double p = mixture(i, j);
      const double z = missing(x, y) ? norm * p / r.mixture.shown : intensity(x, y);
      r.mixture.background += z * flat / p;
      for (std::size_t k = 0; k < targets.size(); ++k) {
        TargetSums& s = r.sums[k];
        const Columns &c = columns[k], &q = rows[k];
        const double weight = targets[k].proportion * z / p;
        s.count += weight * c.p[i] * q.p[j];
        s.x += weight * c.first[i] * q.p[j], s.y += weight * c.p[i] * q.first[j];
        s.xx += weight * c.second[i] * q.p[j], s.yy += weight * c.p[i] * q.second[j];
        if (!missing(x, y)) s.shown += c.p[i] * q.p[j];
      }
    }
  }
  for (std::size_t k = 0; k < targets.size(); ++k) {
    TargetSums& s = r.sums[k];
    s.x = targets[k].x + s.x / s.count, s.y = targets[k].y + s.y / s.count;
    s.xx /= s.count, s.yy /= s.count;
  }
  return r;
}

void expect_near(const Result& got, const Result& want, double relative) {
  ASSERT_EQ(got.sums.size(), want.sums.size());
  for (std::size_t k = 0; k < want.sums.size(); ++k) {
    const TargetSums &g = got.sums[k], &w = want.sums[k];
    EXPECT_NEAR(g.count, w.count, relative * w.count) << k;
    EXPECT_NEAR(g.x, w.x, relative * std::sqrt(w.xx)) << k;
    EXPECT_NEAR(g.y, w.y, relative * std::sqrt(w.yy)) << k;
    EXPECT_NEAR(g.xx, w.xx, relative * w.xx) << k;
    EXPECT_NEAR(g.yy, w.yy, relative * w.yy) << k;
    EXPECT_NEAR(g.shown, w.shown, relative) << k;
  }
  EXPECT_NEAR(got.mixture.background, want.mixture.background, relative * want.mixture.background);
  EXPECT_NEAR(got.mixture.shown, want.mixture.shown, relative);
  EXPECT_NEAR(got.mixture.log_likelihood, want.mixture.log_likelihood,
              relative * std::abs(want.mixture.log_likelihood));
}

class CellIntegralsOn : public testing::TestWithParam<DeviceKind> {
 protected:
  Device device_ = GetParam() == DeviceKind::serial ? Device::serial() : Device::tbb(2);
  double tolerance_ = GetParam() == DeviceKind::serial ? 2e-6 : 1e-5;
  Image<float> image_ = noise_image(48, 40);

  void expect_quadrature(const CellIntegrals::Args& args,
                         const std::vector<HistogramTarget>& targets) {
    expect_near(integrate(device_, args, targets), by_quadrature(args, targets), tolerance_);
  }
  /// A window so wide that what it leaves out does not count.
  CellIntegrals::Args args() const {
    return {.frame = image_.view(), .background = 0.7, .reach = 7};
  }
};

TEST_P(CellIntegralsOn, OneTargetIsWhatQuadratureOverTheWholeFrameGives) {
  expect_quadrature(args(), {{20.3, 17.9, 1.3, 1.7, 0.3}});
  expect_quadrature(args(), {{20.5, 18.5, 0.4, 0.9, 0.3}});
  expect_quadrature(args(), {{24, 20, 12, 20, 0.3}});
}

TEST_P(CellIntegralsOn, OverlappingTargetsShareCellsByTheTotalProbability) {
  expect_quadrature(args(), {{20.3, 17.9, 1.3, 1.7, 0.1},
                             {22.1, 18.4, 1.1, 1.1, 0.05},
                             {20.3, 17.9, 1.3, 1.7, 0.02},
                             {28.0, 25.0, 2.5, 1.2, 0.08},
                             {24.0, 20.0, 9.0, 6.0, 0.05}});
}

TEST_P(CellIntegralsOn, AtTheBorderAnOutsidePartOfATargetIsLost) {
  const std::vector<HistogramTarget> targets{
      {0, 0, 1.5, 1.5, 0.1}, {47.4, 20, 1.2, 1.4, 0.1}, {10, 41, 1.5, 1.5, 0.1}};
  expect_quadrature(args(), targets);
  EXPECT_LT(integrate(device_, args(), targets).sums[0].shown, 0.5);
}

TEST_P(CellIntegralsOn, ThresholdsMakeCellsDark) {
  CellIntegrals::Args a = args();
  a.rule = {.threshold = 1, .subtract = true};
  expect_quadrature(a, {{20.3, 17.9, 1.3, 1.7, 0.3}});
  a.rule.subtract = false;
  expect_quadrature(a, {{20.3, 17.9, 1.3, 1.7, 0.3}});
}

TEST_P(CellIntegralsOn, CellsWithoutDataGiveTheirExpectation) {
  const std::vector<Box> missing{{15, 15, 21, 19}, {40, -5, 60, 12}, {18, 17, 23, 18}};
  CellIntegrals::Args a = args();
  a.rule.missing = missing;
  const std::vector<HistogramTarget> targets{
      {20.3, 17.9, 1.3, 1.7, 0.1}, {23, 18.4, 2, 1.1, 0.05}, {44, 5, 1, 1, 0.1}};
  expect_quadrature(a, targets);
  a.rule.threshold = 0.8f, a.rule.truncate_dark = true;
  expect_quadrature(a, targets);
}

TEST_P(CellIntegralsOn, TheTotalLeavesOutWhatIsNotFinite) {
  const float inf = std::numeric_limits<float>::infinity();
  for (const int width : {1, 7, 8, 16, 23, 37}) {
    Image<float> image = noise_image(width, 9);
    image.view()(width / 2, 1) = inf;
    image.view()(width - 1, 4) = -inf;
    image.view()(0, 5) = image.view()(width - 1, 8) = std::numeric_limits<float>::quiet_NaN();
    for (const CellRule& rule : {CellRule{0.5F, true}, CellRule{-0.5F, true}, CellRule{0.5F, false},
                                 CellRule{0.5F, true, true}}) {
      CellTotal total, truth;
      device_.run<SumCells>({image.view(), rule, &total});
      SumCells::serial({image.view(), rule, &truth});
      EXPECT_NEAR(total.norm, truth.norm, 1e-6 * (1 + truth.norm)) << width;
      EXPECT_EQ(total.shown, truth.shown) << width;
      EXPECT_TRUE(std::isfinite(total.norm)) << width;
    }
  }
}

TEST_P(CellIntegralsOn, ScalingTheIntensityScalesCountsAndNothingElse) {
  const std::vector<HistogramTarget> targets{{20.3, 17.9, 1.3, 1.7, 0.1}, {22, 18, 1, 1, 0.1}};
  CellIntegrals::Args a = args();
  const Result one = integrate(device_, a, targets);
  Image<float> brighter(48, 40);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 48; ++x) brighter.view()(x, y) = 64 * image_.view()(x, y);
  }
  a.frame = brighter.view();
  const Result scaled = integrate(device_, a, targets);
  for (std::size_t k = 0; k < targets.size(); ++k) {
    EXPECT_DOUBLE_EQ(scaled.sums[k].count, 64 * one.sums[k].count);
    EXPECT_DOUBLE_EQ(scaled.sums[k].x, one.sums[k].x);
    EXPECT_DOUBLE_EQ(scaled.sums[k].yy, one.sums[k].yy);
  }
}

TEST_P(CellIntegralsOn, ATargetThatSeesNoCellCountsNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Result r =
      integrate(device_, args(), {{-30, 5, 1, 1, 0.1}, {nan, 5, 1, 1, 0.1}, {1e300, 5, 1, 1, 0.1}});
  for (const TargetSums& s : r.sums) EXPECT_EQ(s.count + s.shown, 0);
  EXPECT_EQ(r.sums[0].x, -30);
  EXPECT_EQ(r.sums[0].xx, 1);
}

TEST_P(CellIntegralsOn, ADarkFrameCountsNothing) {
  const Image<float> dark(48, 40);
  CellIntegrals::Args a = args();
  a.frame = dark.view();
  const Result r = integrate(device_, a, {{20, 20, 1, 1, 0.3}});
  EXPECT_EQ(r.sums[0].count, 0);
  EXPECT_EQ(r.sums[0].x, 20);
  EXPECT_EQ(r.mixture.background, 0);
}

TEST_P(CellIntegralsOn, AFarTailStaysInsideItsCells) {
  Image<float> image(200, 9);
  image.view()(106, 4) = 1;
  const Result r = integrate(device_, {.frame = image.view(), .background = 1e-9, .reach = 7},
                             {{100, 4, 1, 1, 0.3}});
  EXPECT_GT(r.sums[0].count, 0);
  EXPECT_GE(r.sums[0].x, 105.5);
  EXPECT_LE(r.sums[0].x, 106.5);
  EXPECT_GE(r.sums[0].xx, 5.5 * 5.5);
}

TEST_P(CellIntegralsOn, RefusesWhatIsNoMixture) {
  EXPECT_THROW(integrate(device_, {.frame = image_.view(), .background = 0}, {}),
               std::invalid_argument);
  EXPECT_THROW(integrate(device_, args(), {{5, 5, 0, 1, 0.1}}), std::invalid_argument);
  EXPECT_THROW(integrate(device_, args(), {{5, 5, 1, 1, -0.1}}), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Devices, CellIntegralsOn,
                         testing::Values(DeviceKind::serial, DeviceKind::tbb),
                         [](const testing::TestParamInfo<DeviceKind>& kind) {
                           return std::string(name(kind.param));
                         });

TEST(CellIntegrals, TheLikelihoodNeverFallsFromStepToStep) {
  Image<float> image = noise_image(48, 40);
  for (int y = 15; y < 22; ++y) {
    for (int x = 17; x < 24; ++x) image.view()(x, y) += 12;
  }
  std::vector<HistogramTarget> targets{{17, 16, 3, 3, 0.2}, {30, 30, 2, 2, 0.2}};
  double background = 0.6, last = -std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Result r = integrate(
        Device::serial(), {.frame = image.view(), .background = background, .reach = 8}, targets);
    EXPECT_GT(r.mixture.log_likelihood, last - 1e-6) << iteration;
    last = r.mixture.log_likelihood;
    double expected = r.mixture.background;
    for (const TargetSums& s : r.sums) expected += s.count;
    background = r.mixture.background / expected;
    for (std::size_t k = 0; k < targets.size(); ++k) {
      const TargetSums& s = r.sums[k];
      const double dx = s.x - targets[k].x, dy = s.y - targets[k].y;
      targets[k] = {s.x, s.y, std::sqrt(s.xx - dx * dx), std::sqrt(s.yy - dy * dy),
                    s.count / expected};
    }
  }
  EXPECT_NEAR(targets[0].x, 20, 0.5);
  EXPECT_NEAR(targets[0].y, 18, 0.5);
}

}  // namespace
}  // namespace glint
