// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/scenario/scenario.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "glint/engine/scenario/scenes.hpp"

namespace glint {
namespace {

bool same_bits(const Image<float>& a, const Image<float>& b) {
  if (a.width() != b.width() || a.height() != b.height()) return false;
  for (int y = 0; y < a.height(); ++y) {
    const std::size_t bytes = sizeof(float) * static_cast<std::size_t>(a.width());
    if (std::memcmp(a.view().row(y), b.view().row(y), bytes) != 0) return false;
  }
  return true;
}

Scene quiet_scene(double x, double y) {
  Scene scene;
  scene.width = 31, scene.height = 17, scene.frames = 1;
  scene.noise_sigma = 0;
  scene.point_spread = PointSpread::of(0.7);
  scene.targets = {{0, 1, 10, fly({x, y, 0, 0})}};
  return scene;
}

struct Moments {
  double sum = 0, x = 0, y = 0;
};

Moments moments(const Image<float>& image) {
  Moments m;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const double v = image.view()(x, y);
      m.sum += v, m.x += v * x, m.y += v * y;
    }
  }
  m.x /= m.sum, m.y /= m.sum;
  return m;
}

TEST(Path, TurnsAtTheGivenRateAndKeepsItsSpeed) {
  const double rate = std::numbers::pi / 2;
  const Path path = fly({10, 10, 2, 0}, {{1, 0}, {1, rate}});
  const Kinematics straight = path(1), turned = path(2), after = path(3);
  EXPECT_DOUBLE_EQ(straight.x, 12);
  EXPECT_NEAR(turned.x, 12 + 2 / rate, 1e-12);  // a quarter circle of radius v / rate
  EXPECT_NEAR(turned.y, 10 + 2 / rate, 1e-12);  // clockwise on the screen: y grows
  EXPECT_NEAR(turned.vx, 0, 1e-12);
  EXPECT_NEAR(turned.vy, 2, 1e-12);
  EXPECT_NEAR(after.y, turned.y + 2, 1e-12);
}

TEST(Path, SplineIsSmoothAndItsVelocityIsItsDerivative) {
  const Path path = fly_spline({{0, 0}, {10, 3}, {20, -8}, {30, 5}, {40, 9}, {50, 0}}, 0.5);
  for (double t = 0.01; t < 8; t += 0.173) {
    const double h = 1e-5;
    const Kinematics k = path(t), a = path(t - h), b = path(t + h);
    EXPECT_NEAR(k.vx, (b.x - a.x) / (2 * h), 1e-6) << t;
    EXPECT_NEAR(k.vy, (b.y - a.y) / (2 * h), 1e-3) << t;
  }
  EXPECT_NEAR(path(0).x, 10, 1e-12);
  EXPECT_THROW(fly_spline({{0, 0}, {1, 1}, {2, 2}}, 1), std::invalid_argument);
}

TEST(Render, PutsAllOfTheIntensityAtTheTruePlace) {
  const Moments m = moments(render(quiet_scene(15.3, 8.6), 1, 0));
  EXPECT_NEAR(m.sum, 10, 1e-4);
  EXPECT_NEAR(m.x, 15.3, 1e-4);
  EXPECT_NEAR(m.y, 8.6, 1e-4);
}

TEST(Render, ClipsATargetAtTheBorder) {
  EXPECT_NEAR(moments(render(quiet_scene(-0.5, 8), 1, 0)).sum, 5, 1e-4);
  const Image<float> gone = render(quiet_scene(-100, 8), 1, 0);
  EXPECT_EQ(gone.view()(0, 8), 0);
}

TEST(Render, NoiseIsWhiteOfTheGivenSigma) {
  NoiseScene config;
  config.width = 201, config.height = 133, config.noise = 3;
  const Image<float> image = render(make_scene(config), 5, 2);
  double sum = 0, squares = 0, neighbours = 0;
  const int n = config.width * config.height;
  for (int y = 0; y < config.height; ++y) {
    for (int x = 0; x < config.width; ++x) {
      const double v = image.view()(x, y);
      sum += v, squares += v * v;
      if (x > 0) neighbours += v * image.view()(x - 1, y);
    }
  }
  EXPECT_NEAR(sum / n, 0, 0.06);
  EXPECT_NEAR(std::sqrt(squares / n), 3, 0.06);
  EXPECT_NEAR(neighbours / squares, 0, 0.03);
}

TEST(Render, IsAFunctionOfSceneSeedAndFrame) {
  for (const SceneEntry& entry : all_scenes()) {
    const ConfigSection config = entry.config();
    const Scene scene = entry.make(config), again = entry.make(config);
    EXPECT_EQ(config.name(), "scenes." + std::string(entry.name));
    EXPECT_EQ(scene.name, entry.name);
    EXPECT_TRUE(same_bits(render(scene, 3, 5), render(again, 3, 5))) << entry.name;
    EXPECT_FALSE(same_bits(render(scene, 3, 5), render(scene, 4, 5))) << entry.name;
    EXPECT_FALSE(same_bits(render(scene, 3, 5), render(scene, 3, 6))) << entry.name;
  }
}

TEST(Render, JitterMovesTheImageNotTheTruth) {
  Scene scene = quiet_scene(15, 8);
  scene.jitter_sigma = 0.5;
  double squares = 0;
  const int seeds = 400;
  for (int seed = 0; seed < seeds; ++seed) {
    const Moments m = moments(render(scene, static_cast<std::uint64_t>(seed), 0));
    squares += (m.x - 15) * (m.x - 15) + (m.y - 8) * (m.y - 8);
  }
  EXPECT_NEAR(squares / (2 * seeds), 0.25, 0.05);
  EXPECT_EQ(truth_at(scene, 0).at(0).x, 15);
}

TEST(Scenes, PhdSceneIsTheOneOfThePaper) {
  PhdScene config;
  config.snr = 12;
  const Scene scene = make_scene(config);
  const std::vector<TruthPoint> truth = truth_of(scene);
  ASSERT_EQ(truth.size(), 20u);
  EXPECT_EQ(truth.front().frame, 4);  // the paper's frame 5
  EXPECT_EQ(truth.back().frame, 23);
  EXPECT_DOUBLE_EQ(truth.front().x, 4.5);
  EXPECT_DOUBLE_EQ(truth.front().y, 4.5);
  EXPECT_NEAR(truth.back().x, 4.5 + 19 * 0.9, 1e-12);
  EXPECT_NEAR(truth.back().y, 4.5 + 19 * 0.2, 1e-12);
  EXPECT_NEAR(truth.front().intensity, 12.257, 5e-4);
}

TEST(Scenes, IrClipShowsItsTargetsInsideTheFrameInGreyLevels) {
  for (const double speed : {2.0, 17.0}) {
    IrClipScene config;
    config.speed = speed;
    const Scene scene = make_scene(config);
    EXPECT_EQ(scene.targets.size(), 6u);
    const double interval = scene.interval;
    double fastest = 0;
    for (const TruthPoint& t : truth_of(scene)) {
      EXPECT_TRUE(t.x > 5 && t.x < 1019 && t.y > 5 && t.y < 200) << t.x << "," << t.y;
      fastest = std::max(fastest, std::hypot(t.vx, t.vy) * interval);
    }
    EXPECT_GE(fastest, speed);
    EXPECT_LE(fastest, 1.3 * speed);
    const Image<float> image = render(scene, 1, 30);
    for (int x = 0; x < scene.width; ++x) {
      const float v = image.view()(x, 77);
      EXPECT_EQ(v, std::round(v));
      EXPECT_TRUE(v > 60 && v < 200);
    }
  }
}

TEST(Scenes, UnknownNameListsTheKnownOnes) {
  try {
    find_scene("nowhere");
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_NE(std::string(e.what()).find("phd-5.1, ir-clip, crossing, noise"), std::string::npos);
  }
}

TEST(SceneSource, DeliversEveryFrameOnceWithItsTime) {
  NoiseScene config;
  config.frames = 3;
  SceneSource source(make_scene(config), 9);
  EXPECT_EQ(source.frame_count(), 3);
  for (int k = 0; k < 3; ++k) {
    const auto frame = source.next();
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->time, k);
    const Image<float> want = render(source.scene(), 9, k);
    EXPECT_EQ(std::get<const float*>(frame->pixels.data)[frame->pixels.pitch], want.view()(0, 1));
  }
  EXPECT_FALSE(source.next().has_value());
}

}  // namespace
}  // namespace glint
