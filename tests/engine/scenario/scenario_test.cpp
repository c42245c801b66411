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

/// The paper's frames and cells: counted from 1, a cell [i-1, i] has its centre at i - .5.
struct PaperPlace {
  std::int64_t first, last;
  double x, y, vx, vy;  // at the first frame
};

void expect_life(const std::vector<TruthPoint>& truth, std::int64_t id, const PaperPlace& paper) {
  std::vector<TruthPoint> life;
  for (const TruthPoint& t : truth) {
    if (t.track_id == id) life.push_back(t);
  }
  ASSERT_FALSE(life.empty());
  EXPECT_EQ(life.front().frame + 1, paper.first);
  EXPECT_EQ(life.back().frame + 1, paper.last);
  EXPECT_DOUBLE_EQ(life.front().x + 0.5, paper.x);
  EXPECT_DOUBLE_EQ(life.front().y + 0.5, paper.y);
  EXPECT_DOUBLE_EQ(life.front().vx, paper.vx);
  EXPECT_DOUBLE_EQ(life.front().vy, paper.vy);
}

/// The target's heading [deg] from x towards y, after `age` [s].
double heading(const Scene& scene, std::size_t target, double age) {
  const Kinematics k = scene.targets.at(target).path(age);
  return std::atan2(k.vy, k.vx) * 180 / std::numbers::pi;
}

void expect_inside_at_constant_speed(const Scene& scene) {
  std::vector<double> speed(scene.targets.size(), 0);
  for (const TruthPoint& t : truth_of(scene)) {
    double& first = speed[static_cast<std::size_t>(t.track_id)];
    if (first == 0) first = std::hypot(t.vx, t.vy);
    EXPECT_NEAR(std::hypot(t.vx, t.vy), first, 1e-12);
    EXPECT_TRUE(t.x > 2 && t.x < scene.width - 3) << t.track_id << " " << t.frame << " " << t.x;
    EXPECT_TRUE(t.y > 2 && t.y < scene.height - 3) << t.track_id << " " << t.frame << " " << t.y;
  }
}

TEST(Scenes, ThePhdManoeuvreIsTheOneOfThePaper) {
  const Scene scene = make_scene(PhdManoeuvreScene{});
  EXPECT_EQ(scene.frames, 40);
  const std::vector<TruthPoint> truth = truth_of(scene);
  expect_life(truth, 0, {5, 34, 15, 10, 1.5, 0});
  expect_life(truth, 1, {5, 34, 25, 18, -1.3, 0});
  expect_life(truth, 2, {10, 30, 20, 35, 0, -1.5});
  expect_inside_at_constant_speed(scene);
  EXPECT_NEAR(truth.front().intensity, 9.74, 5e-3);
  EXPECT_NEAR(heading(scene, 0, 9.99), 0, 1e-9);
  EXPECT_NEAR(heading(scene, 0, 12), 30, 1e-9);
  EXPECT_NEAR(heading(scene, 0, 25), 150, 1e-9);
  EXPECT_NEAR(heading(scene, 1, 25), 30, 1e-9);  // from 180 back by 150
  // Half a turn that is 180 - 2 * 15 degrees long spans the circle of radius v / rate.
  const double radius = 1.5 / (15 * std::numbers::pi / 180);
  const Kinematics in = scene.targets[0].path(10), out = scene.targets[0].path(20);
  EXPECT_NEAR(std::hypot(out.x - in.x, out.y - in.y),
              2 * radius * std::sin(75 * std::numbers::pi / 180), 1e-9);
}

TEST(Scenes, ThePhdArcsTurnAsStatedEveryTwoSeconds) {
  const Scene scene = make_scene(PhdArcsScene{});
  EXPECT_EQ(scene.frames, 42);
  EXPECT_EQ(scene.interval, 2);
  EXPECT_EQ(scene.width, 80);
  EXPECT_EQ(scene.height, 100);
  const std::vector<TruthPoint> truth = truth_of(scene);
  expect_life(truth, 0, {8, 29, 15, 20, 0.9, 0.45});
  expect_life(truth, 1, {8, 29, 66, 28, -0.75, 0.7});
  expect_life(truth, 2, {15, 34, 30, 85, 0.35, -0.95});
  expect_inside_at_constant_speed(scene);
  EXPECT_NEAR(scene.targets[0].intensity, 10.104, 5e-4);
  EXPECT_NEAR(scene.targets[2].intensity, 8.026, 5e-4);
  const auto turned = [&](std::size_t target, double age) {
    return heading(scene, target, age) - heading(scene, target, 0);
  };
  for (const std::size_t target : {0u, 2u}) EXPECT_NEAR(turned(target, 28), 48, 1e-9);
  EXPECT_NEAR(turned(1, 28), -48, 1e-9);
  EXPECT_NEAR(turned(0, 40), 48, 1e-9);
  EXPECT_NEAR(turned(2, 38), 48 - 10 * 3, 1e-9);  // clockwise to the end
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
    const std::string message = e.what();
    for (const SceneEntry& scene : all_scenes()) {
      EXPECT_NE(message.find(scene.name), std::string::npos) << scene.name;
    }
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
