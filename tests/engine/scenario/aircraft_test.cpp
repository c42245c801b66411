// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "glint/engine/scenario/scenes.hpp"

namespace glint {
namespace {

constexpr double kSpeed[] = {2.7, 4, 3.4, 3, 2.4, 1.5, 3.2};  // P-HPMHT table 1
constexpr double kSnr[] = {4.9, 4.7, 3.9, 2.6, 3.7, 7, 7.6};
constexpr double kArea[] = {200, 260, 232, 84, 75, 40, 350};

Scene scene_of(int scenario, int variant = 0, double clutter = 1) {
  AircraftScene config;
  config.scenario = scenario, config.variant = variant, config.clutter = clutter;
  return make_scene(config);
}

double area(const Patch& patch) {
  return std::accumulate(patch.share.begin(), patch.share.end(), 0.0);
}

template <class F>
void each_pixel(const Patch& patch, const F& f) {
  std::size_t i = 0;
  for (int y = patch.box.y0; y < patch.box.y1; ++y) {
    for (int x = patch.box.x0; x < patch.box.x1; ++x, ++i) f(x, y, patch.share[i]);
  }
}

TEST(Aircraft, HasTheAreaOfTheTableAtEveryFrame) {
  for (int scenario = 1; scenario <= 7; ++scenario) {
    const Scene scene = scene_of(scenario, scenario);
    for (const int frame : {0, 7, 20, 40}) {
      const double wanted = kArea[scenario - 1];
      EXPECT_NEAR(area(patch_at(scene, 0, frame)), wanted, 0.02 * wanted) << scenario;
    }
  }
}

TEST(Aircraft, TruthIsTheCentroidOfTheSilhouette) {
  for (int scenario = 1; scenario <= 7; ++scenario) {
    const Scene scene = scene_of(scenario);
    for (const int frame : {0, 13, 40}) {
      double x_sum = 0, y_sum = 0;
      const Patch patch = patch_at(scene, 0, frame);
      each_pixel(patch,
                 [&](int x, int y, double share) { x_sum += share * x, y_sum += share * y; });
      const TruthPoint truth = truth_at(scene, frame).at(0);
      EXPECT_NEAR(x_sum / area(patch), truth.x, 0.1) << scenario;
      EXPECT_NEAR(y_sum / area(patch), truth.y, 0.1) << scenario;
    }
  }
}

/// 20 log10(mean target RPIM / mean background RPIM) of a rendered frame.
double measured_snr(const Scene& scene, int frame) {
  const Image<float> image = render(scene, 1, frame);
  const auto rpim = [&](int x, int y) { return 255 / static_cast<double>(image.view()(x, y)); };
  double target = 0, all = 0;
  const Patch patch = patch_at(scene, 0, frame);
  each_pixel(patch, [&](int x, int y, double share) {
    if (share > 0) target += share * rpim(x, y);
  });
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) all += rpim(x, y);
  }
  const double pixels = static_cast<double>(image.width()) * image.height();
  const double background = (all - target) / (pixels - area(patch));
  return 20 * std::log10(target / area(patch) / background);
}

TEST(Aircraft, IsAsDarkAsTheSignalToNoiseRatioSays) {
  for (int scenario = 1; scenario <= 7; ++scenario) {
    const Scene clear = scene_of(scenario, 2, 0), cloudy = scene_of(scenario, 2, 1);
    for (const int frame : {3, 31}) {
      EXPECT_NEAR(measured_snr(clear, frame), kSnr[scenario - 1], 0.1) << scenario;
      EXPECT_NEAR(measured_snr(cloudy, frame), kSnr[scenario - 1], 0.5) << scenario;
    }
  }
}

TEST(Aircraft, FliesACurveAtTheSpeedOfTheTable) {
  for (int scenario = 1; scenario <= 7; ++scenario) {
    const auto truth = truth_of(scene_of(scenario, 4));
    double turned = 0;
    for (std::size_t k = 1; k < truth.size(); ++k) {
      const TruthPoint &a = truth[k - 1], &b = truth[k];
      EXPECT_NEAR(std::hypot(b.x - a.x, b.y - a.y), kSpeed[scenario - 1], 0.01) << scenario;
      turned += std::abs(std::remainder(std::atan2(b.vy, b.vx) - std::atan2(a.vy, a.vx), 6.283185));
    }
    EXPECT_GT(turned, 0.9) << scenario;
  }
}

TEST(Aircraft, StaysInThePicture) {
  for (int scenario = 1; scenario <= 7; ++scenario) {
    for (int variant = 0; variant < 10; ++variant) {
      const Scene scene = scene_of(scenario, variant);
      for (const int frame : {0, 20, 40}) {
        each_pixel(patch_at(scene, 0, frame), [&](int x, int y, double share) {
          if (share == 0) return;
          EXPECT_TRUE(x >= 0 && y >= 0 && x < scene.width && y < scene.height);
        });
      }
    }
  }
}

TEST(Aircraft, ItsShapeVariesWithTime) {
  for (const int scenario : {1, 5}) {
    Silhouette shape = *scene_of(scenario).targets[0].silhouette;
    const Kinematics still{20, 20, 1, 0};
    const Patch a = shape.at(0, still), b = shape.at(3, still);
    double other = 0;
    each_pixel(a, [&](int x, int y, double share) {
      if (!b.box.contains(x, y)) return;
      const int i = (y - b.box.y0) * (b.box.x1 - b.box.x0) + x - b.box.x0;
      other += std::abs(share - static_cast<double>(b.share[static_cast<std::size_t>(i)]));
    });
    EXPECT_GT(other, 1) << scenario;
  }
}

TEST(Aircraft, AVariantIsAnotherSkyAndPathAndTheSameVariantIsTheSame) {
  const Scene a = scene_of(3, 1), again = scene_of(3, 1), b = scene_of(3, 2);
  const Image<float> x = render(a, 5, 9), y = render(again, 5, 9), z = render(b, 5, 9);
  int same = 0;
  for (int row = 0; row < x.height(); ++row) {
    EXPECT_TRUE(std::equal(x.view().row(row), x.view().row(row) + 200, y.view().row(row)));
    for (int col = 0; col < 200; ++col) same += x.view()(col, row) == z.view()(col, row);
  }
  EXPECT_LT(same, 8000);
  EXPECT_NE(truth_of(a).front(), truth_of(b).front());
}

TEST(Silhouette, IsCutOffAtTheBorder) {
  Image<float> image(20, 20);
  const Patch patch = Silhouette{}.at(0, {-1, 19, 1, 0});
  paint(patch, image.view());
  each_pixel(patch, [&](int x, int y, double share) {
    if (image.view().contains(x, y)) {
      EXPECT_EQ(image.view()(x, y) > 0, share > 0) << x << ' ' << y;
    }
  });
  EXPECT_GT(image.view()(0, 19), 0);
}

}  // namespace
}  // namespace glint
