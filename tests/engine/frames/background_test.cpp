// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/background.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "frame_preparer_scene.hpp"

namespace glint::test {
namespace {

constexpr int kSize = 40;

/// A model, and frames of one grey level that it learns.
class Model {
 public:
  explicit Model(const FramesConfig& config)
      : model(make_background(config, Device::serial())), estimate(kSize, kSize) {}
  void learn(float level) {
    const std::vector<float> pixels(kSize * kSize, level);
    give(pixels, [&](const BackgroundInput& input) { model->learn(input); });
  }
  /// The background of a frame; its first pixel.
  float background(const std::vector<float>& pixels) {
    give(pixels, [&](const BackgroundInput& input) { model->estimate(input, estimate.view()); });
    return estimate.view()(0, 0);
  }
  float background(float level = 100) {
    return background(std::vector<float>(kSize * kSize, level));
  }
  std::unique_ptr<Background> model;
  Image<float> estimate;

 private:
  template <class F>
  static void give(const std::vector<float>& pixels, F&& f) {
    const RawPixels frame = raw(pixels, kSize, kSize);
    f({frame, FrameView{pixels.data(), kSize, kSize, kSize}, true});
  }
};

FramesConfig temporal() {
  FramesConfig c;
  c.background_frames = 6, c.background_stride = 2;  // three samples
  return c;
}

// Frame t has level t. Kept are {0}, {0, 1}, {0, 1, 2}, then {0, 2, 3} (one in the middle left),
// {0, 3, 5} and, 0 being older than the window, {3, 5, 7}: every second frame by then.
TEST(TemporalBackground, IsTheMedianOfItsSamples) {
  Model m(temporal());
  const std::vector<float> medians{0, 0, 1, 2, 2, 3, 3, 5, 5, 7};
  for (std::size_t t = 0; t < medians.size(); ++t) {
    m.learn(static_cast<float>(t));
    if (t == 1) continue;  // of an even number
    EXPECT_EQ(m.background(), medians[t]) << t;
  }
}

TEST(TemporalBackground, IsTheFramesOwnSpatialMedianWhileThereIsNoSample) {
  Model m(temporal());
  EXPECT_EQ(m.background(80), 80);
  EXPECT_TRUE(m.model->provisional());
  m.learn(3);
  EXPECT_EQ(m.background(80), 3);
  EXPECT_FALSE(m.model->provisional());
}

FramesConfig registered() {
  FramesConfig c;
  c.background = BackgroundKind::registered, c.registered_frames = 3;
  return c;
}

TEST(RegisteredBackground, IsTheMedianOfTheLastSamples) {
  Model m(registered());
  for (const float level : {9, 1, 2}) m.learn(level);
  EXPECT_EQ(m.background(), 2);
  m.learn(3);
  EXPECT_EQ(m.background(), 2);
  m.learn(4);
  EXPECT_EQ(m.background(), 3);
  m.learn(5);
  EXPECT_EQ(m.background(), 4);
}

TEST(RegisteredBackground, TakesOneFrameAStride) {
  FramesConfig config = registered();
  config.registered_stride = 2;
  Model m(config);
  for (const float level : {1, 20, 2, 20, 3, 20}) m.learn(level);
  EXPECT_EQ(m.background(), 2);
}

TEST(RegisteredBackground, MovesASampleOnlyWhereThatPays) {
  Model still(registered()), moving(registered());
  const auto shares = [](const Model& m) {
    const std::string text = m.model->description();
    return text.substr(text.find(", ") + 2);
  };
  for (const float level : {1, 2, 3}) still.learn(level);
  still.background();
  EXPECT_EQ(shares(still), "0 of 3 shifts accepted");
  Scene scene;
  scene.width = scene.height = kSize;
  scene.noise = 0, scene.amplitude = 0, scene.pan = 2;
  for (int t = 0; t < 3; ++t) {
    const std::vector<float> pixels = scene.at(t);
    const RawPixels frame = raw(pixels, kSize, kSize);
    moving.model->learn({frame, FrameView{pixels.data(), kSize, kSize, kSize}, true});
  }
  const std::vector<float> now = scene.at(3);
  moving.background(now);
  EXPECT_EQ(shares(moving), "3 of 3 shifts accepted");
  EXPECT_NEAR(moving.estimate.view()(20, 20), now[20 * kSize + 20], 2);
}

// A window of 17 px sees a patch of 11 px as less than half, one of 9 px as all.
TEST(SpatialBackground, IsTheMedianOfItsWindow) {
  FramesConfig config;
  config.background = BackgroundKind::spatial, config.spatial_window = 17;
  std::vector<float> pixels(kSize * kSize, 10);
  for (int y = 15; y <= 25; ++y) std::fill_n(pixels.begin() + y * kSize + 15, 11, 90.0F);
  Model wide(config);
  wide.background(pixels);
  EXPECT_EQ(wide.estimate.view()(20, 20), 10);
  EXPECT_EQ(wide.model->description(), "background: spatial median of 17 px");
  config.spatial_window = 9;
  Model narrow(config);
  narrow.background(pixels);
  EXPECT_EQ(narrow.estimate.view()(20, 20), 90);
}

TEST(NoBackground, IsZeroAndWrittenOnce) {
  FramesConfig config;
  config.background = BackgroundKind::none;
  Model m(config);
  m.estimate.view()(0, 0) = 5;
  EXPECT_EQ(m.background(), 0);
  m.estimate.view()(0, 0) = 5;
  EXPECT_EQ(m.background(), 5);
  m.model->rewrite();
  EXPECT_EQ(m.background(), 0);
}

}  // namespace
}  // namespace glint::test
