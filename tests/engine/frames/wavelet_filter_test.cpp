// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/wavelet_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

constexpr double kAll = -1e9;  // a k that every coefficient exceeds
constexpr std::size_t kScales = WaveletFilter::kScales;
constexpr auto& kUnitNoise = WaveletFilter::kUnitNoise;
constexpr double kUnitSum = WaveletFilter::kUnitSum;

Image<float> frame_of(int width, int height, const std::function<float(int, int)>& pixel) {
  Image<float> frame(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) frame.view()(x, y) = pixel(x, y);
  }
  return frame;
}

Image<float> noise_of(int width, int height, float sigma, std::uint64_t number = 0) {
  const RandomKey key = random_key(4, number, Purpose::trial);
  return frame_of(width, height, [&](int x, int y) {
    return sigma * random_normals(key, static_cast<std::uint32_t>(y * width + x)).n[0];
  });
}

/// The definition, scalar and in double, a frame as one vector of rows.
struct Reference {
  int width, height;
  std::array<std::vector<double>, kScales + 1> level;
  std::array<double, kScales> sigma;

  explicit Reference(FrameView frame) : width(frame.width), height(frame.height) {
    for (int y = 0; y < height; ++y)
      level[0].insert(level[0].end(), frame.row(y), frame.row(y) + width);
    for (std::size_t j = 0; j < kScales; ++j) level[j + 1] = smoothed(level[j], 1 << j);
    for (std::size_t j = 0; j < kScales; ++j) sigma[j] = std::max(kUnitNoise[j], mad(j));
  }
  static int reflected(int i, int n) {
    while (n > 1 && (i < 0 || i >= n)) i = i < 0 ? -i : 2 * (n - 1) - i;
    return n > 1 ? i : 0;
  }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(reflected(y, height)) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(reflected(x, width));
  }
  std::vector<double> smoothed(const std::vector<double>& from, int hole) const {
    constexpr std::array<double, 5> kTaps{1 / 16., 4 / 16., 6 / 16., 4 / 16., 1 / 16.};
    std::vector<double> to;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        double sum = 0;
        for (int v = -2; v <= 2; ++v) {
          for (int u = -2; u <= 2; ++u) {
            sum += kTaps[static_cast<std::size_t>(v + 2)] * kTaps[static_cast<std::size_t>(u + 2)] *
                   from[at(x + u * hole, y + v * hole)];
          }
        }
        to.push_back(sum);
      }
    }
    return to;
  }
  double plane(std::size_t scale, std::size_t pixel) const {
    return level[scale][pixel] - level[scale + 1][pixel];
  }
  double mad(std::size_t scale) const {
    std::vector<double> known;
    for (std::size_t i = 0; i < level[0].size(); ++i) {
      if (level[0][i] != 0) known.push_back(plane(scale, i));
    }
    if (known.empty()) return 0;
    const auto middle = [](std::vector<double>& values) {
      std::sort(values.begin(), values.end());
      return values[values.size() / 2];
    };
    const double median = middle(known);
    for (double& w : known) w = std::abs(w - median);
    return 1.4826 * middle(known);
  }
  /// NaN where a coefficient lies so close to k that rounding decides.
  double response(std::size_t pixel, double k) const {
    double sum = 0;
    for (std::size_t j = 0; j < kScales; ++j) {
      const double u = plane(j, pixel) / sigma[j];
      if (k != 0 && std::abs(u - k) < 1e-4) return std::nan("");
      sum += u > k ? u : 0;
    }
    return sum / kUnitSum;
  }
};

// Frames smaller than the reach of 8 px, masked pixels, several tiles of rows; all pixels are
// samples of the noise.
TEST(WaveletFilter, IsItsDefinitionAtEverySize) {
  for (const auto& [width, height] :
       {std::pair{1, 1}, {1, 9}, {9, 1}, {2, 3}, {5, 3}, {7, 130}, {33, 65}, {61, 129}}) {
    Image<float> frame = noise_of(width, height, 3);
    for (int y = 0; y < height; y += 4) frame.view()(y % width, y) = 0;
    const Reference reference(frame.view());
    WaveletFilter filter(Device::tbb(2));
    for (const double k : {0.0, 0.7}) {
      const FrameView response = filter.response(frame.view(), k);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const double wanted = reference.response(reference.at(x, y), k);
          ASSERT_EQ(std::isnan(response(x, y)), frame.view()(x, y) == 0);
          if (std::isnan(wanted) || std::isnan(response(x, y))) continue;
          ASSERT_NEAR(response(x, y), wanted, 1e-5)
              << width << 'x' << height << " at " << x << ", " << y << ", k " << k;
        }
      }
    }
  }
}

// Of one bright pixel, c_0 = 1, c_1 = (6/16)^2, c_2 = (44/256)^2, c_3 = (344/4096)^2 there.
TEST(WaveletFilter, OnePixelIsWhatEachScaleSeesOfIt) {
  constexpr std::array kLevel{1.0, 36 / 256.0, 44.0 * 44 / 65536, 344.0 * 344 / 16777216};
  const Image<float> frame =
      frame_of(41, 37, [](int x, int y) { return x == 20 && y == 18 ? 10.0F : 0.0F; });
  std::array<double, kScales> u;
  for (std::size_t j = 0; j < kScales; ++j) u[j] = 10 * (kLevel[j] - kLevel[j + 1]) / kUnitNoise[j];
  WaveletFilter filter(Device::serial());
  const auto at = [&](double k) { return filter.response(frame.view(), k)(20, 18); };
  EXPECT_NEAR(at(0), (u[0] + u[1] + u[2]) / kUnitSum, 1e-5);
  EXPECT_NEAR(at(u[2] + 0.01), (u[0] + u[1]) / kUnitSum, 1e-5);
  EXPECT_NEAR(at(u[1] + 0.01), u[0] / kUnitSum, 1e-5);
  EXPECT_EQ(at(u[0] + 0.01), 0);
}

// A spot of 1 px shows best at scale 1, one of 3 px at scale 3.
TEST(WaveletFilter, LargeSpotsAreSeenByCoarseScales) {
  const auto spot = [](double sigma) {
    return frame_of(65, 65, [sigma](int x, int y) {
      const double r2 = (x - 32) * (x - 32) + (y - 32) * (y - 32);
      return static_cast<float>(1 + 100 * std::exp(-r2 / (2 * sigma * sigma)));
    });
  };
  const auto best = [](FrameView frame) {
    const Reference r(frame);
    std::array<double, kScales> u;
    for (std::size_t j = 0; j < kScales; ++j) u[j] = r.plane(j, r.at(32, 32)) / kUnitNoise[j];
    return std::max_element(u.begin(), u.end()) - u.begin();
  };
  const Image<float> small = spot(0.5), large = spot(3);
  EXPECT_EQ(best(small.view()), 0);
  EXPECT_EQ(best(large.view()), 2);
  WaveletFilter filter(Device::serial());
  EXPECT_GT(filter.response(small.view(), 0)(32, 32), 30);
  EXPECT_GT(filter.response(large.view(), 0)(32, 32), 60);
}

TEST(WaveletFilter, UnitNoiseStaysUnitNoise) {
  constexpr int kSize = 160, kFrames = 12;
  constexpr double kTail = 0.0013499;  // of a normal beyond 3
  WaveletFilter filter(Device::serial());
  double square = 0, pixels = 0, significant = 0;
  for (std::uint64_t f = 0; f < kFrames; ++f) {
    const Image<float> noise = noise_of(kSize, kSize, 1, f);
    const auto sum_inside = [&](FrameView map, auto&& of) {
      double sum = 0;
      for (int y = 10; y < kSize - 10; ++y) {
        for (int x = 10; x < kSize - 10; ++x) sum += of(static_cast<double>(map(x, y)));
      }
      return sum;
    };
    square += sum_inside(filter.response(noise.view(), kAll), [](double v) { return v * v; });
    significant += sum_inside(filter.response(noise.view(), 3), [](double v) { return v > 0; });
    pixels += (kSize - 20) * (kSize - 20);
  }
  EXPECT_NEAR(square / pixels, 1, 0.05);
  // Three tails, less where two scales see the same: at most a tenth.
  EXPECT_LT(significant / pixels, 3 * kTail * 1.1);
  EXPECT_GT(significant / pixels, 3 * kTail * 0.7);
}

// Powers of two leave the digits alone.
TEST(WaveletFilter, MeasuresTheNoiseButNeverLessThanUnitNoise) {
  const auto response = [](float sigma, bool half_masked, double k) {
    const Image<float> noise = noise_of(90, 70, sigma);
    const Image<float> frame = frame_of(
        90, 70, [&](int x, int y) { return half_masked && x < 50 ? 0.0F : noise.view()(x, y); });
    WaveletFilter filter(Device::serial());
    const FrameView map = filter.response(frame.view(), k);
    std::vector<float> row;
    for (int y = 0; y < 70; ++y) row.insert(row.end(), map.row(y) + 60, map.row(y) + 90);
    return row;
  };
  for (const bool half_masked : {false, true}) {
    EXPECT_EQ(response(2, half_masked, 1), response(8, half_masked, 1)) << half_masked;
    std::vector<float> twice = response(0.125F, half_masked, 0);
    for (float& v : twice) v *= 2;
    EXPECT_EQ(twice, response(0.25F, half_masked, 0)) << half_masked;
  }
}

TEST(WaveletFilter, GivesTheSameBitsOnAnyNumberOfThreads) {
  const Image<float> frame = noise_of(131, 300, 2);
  const auto bits = [&](const Device& device) {
    WaveletFilter filter(device);
    const FrameView map = filter.response(frame.view(), 1);
    std::vector<float> all;
    for (int y = 0; y < map.height; ++y) all.insert(all.end(), map.row(y), map.row(y) + map.width);
    return all;
  };
  const std::vector<float> one = bits(Device::serial());
  for (const int threads : {1, 2, 3, 8}) EXPECT_EQ(bits(Device::tbb(threads)), one) << threads;
}

}  // namespace
}  // namespace glint
