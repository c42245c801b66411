// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/imm_pda_ai/imm_pda_ai.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace glint {
namespace {

using Points = std::vector<PointMeasurement>;
constexpr float kBright = 8;  // [sigma]

/// A tracker on frames of 100x100 pixels, and its log.
struct Tracking {
  explicit Tracking(const ImmPdaAiConfig& config) : tracker(config, Device::serial(), 1) {}
  void step(const Points& points) {
    Scan scan;
    scan.frame = frame++, scan.time = static_cast<double>(scan.frame);
    scan.whitened = Frame(Image<float>(100, 100));
    scan.points = points;
    tracker.step(scan, log);
  }
  std::vector<TrackPoint> last() const { return log.at(frame - 1); }

  ImmPdaAi tracker;
  TrackLog log;
  std::int64_t frame = 0;
};

/// Both models alike, and every point in the gate the target's own: a Kalman filter.
ImmPdaAiConfig kalman_config() {
  ImmPdaAiConfig c;
  c.amplitude = AmplitudeModel::none;
  c.noise_slow = c.noise_fast = 0.3;
  c.detection = 0.9999, c.gate = 1000, c.clutter_density = 1e-12;
  c.initiate = false;
  return c;
}

Eigen::Matrix4d both_axes(const Eigen::Matrix2d& axis) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  m.topLeftCorner<2, 2>() = m.bottomRightCorner<2, 2>() = axis;
  return m;
}

/// Of which a float holds every one that lies in a frame.
float sixteenths(double x) { return static_cast<float>(std::round(16 * x) / 16); }

TEST(ImmPdaAi, WithoutClutterIsAKalmanFilter) {
  const ImmPdaAiConfig config = kalman_config();
  Tracking run(config);
  run.tracker.start(20, 30, 1, -0.5);
  run.step({{20, 30, kBright}});

  const Eigen::Matrix4d f = both_axes((Eigen::Matrix2d() << 1, 1, 0, 1).finished());
  const Eigen::Matrix4d q = 0.3 * both_axes((Eigen::Matrix2d() << 1.0 / 3, 0.5, 0.5, 1).finished());
  Eigen::Matrix<double, 2, 4> h = Eigen::Matrix<double, 2, 4>::Zero();
  h(0, 0) = h(1, 2) = 1;
  Eigen::Vector4d x(20, 1, 30, -0.5);
  Eigen::Matrix4d p = Eigen::Vector4d(1, 4, 1, 4).asDiagonal();  // R, velocity_sd^2
  for (int k = 1; k <= 20; ++k) {
    const PointMeasurement z{sixteenths(20 + 1.2 * k + std::sin(k)),
                             sixteenths(30 - 0.4 * k + std::cos(2 * k)), kBright};
    run.step({z});
    x = f * x, p = f * p * f.transpose() + q;
    const Eigen::Matrix2d s = h * p * h.transpose() + Eigen::Matrix2d::Identity();
    const Eigen::Matrix<double, 4, 2> gain = p * h.transpose() * s.inverse();
    x += gain * (Eigen::Vector2d(z.x, z.y) - h * x);
    p = (Eigen::Matrix4d::Identity() - gain * h) * p;
    const auto reported = run.last();
    ASSERT_EQ(reported.size(), 1u);
    EXPECT_NEAR(reported[0].x, x(0), 1e-9);
    EXPECT_NEAR(reported[0].vx, x(1), 1e-9);
    EXPECT_NEAR(reported[0].y, x(2), 1e-9);
    EXPECT_NEAR(reported[0].vy, x(3), 1e-9);
    EXPECT_NEAR(reported[0].var_x, p(0, 0), 1e-9);
  }
}

// Two points, one pixel to either side of where the target must be.
double shift_by_amplitudes(AmplitudeModel model, float left, float right) {
  ImmPdaAiConfig config = kalman_config();
  config.amplitude = model;
  Tracking run(config);
  run.tracker.start(50, 50, 0, 0);
  run.step({{50, 50, 3}});
  run.step({{49, 50, left}, {51, 50, right}});
  return run.last().at(0).x - 50;
}

TEST(ImmPdaAi, AmplitudesWeighTwoPointsByTheirRatio) {
  const double p = 1 + 4 + 0.3 / 3, gain = p / (p + 1);
  for (const AmplitudeModel model : {AmplitudeModel::rayleigh, AmplitudeModel::gaussian}) {
    const TargetAmplitude target(3);
    const auto ratio = [&](double a) { return target.log_ratio(model, a, 2.5); };
    const double difference = std::tanh((ratio(3) - ratio(2.5)) / 2);  // of the two weights
    EXPECT_GT(difference, 0.1);
    EXPECT_NEAR(shift_by_amplitudes(model, 2.5, 3), gain * difference, 1e-6)
        << static_cast<int>(model);
    EXPECT_NEAR(shift_by_amplitudes(model, 3, 2.5), -gain * difference, 1e-6)
        << static_cast<int>(model);
  }
  EXPECT_NEAR(shift_by_amplitudes(AmplitudeModel::none, 2.5, 3), 0, 1e-6);
}

TEST(ImmPdaAi, APointBeyondTheGateDoesNotMoveATrack) {
  ImmPdaAiConfig config = kalman_config();
  config.gate = 9.21;
  const double edge = std::sqrt(9.21 * (1 + 4 + 0.3 / 3 + 1));  // [px], variance of prediction + R
  for (const double share : {0.99, 1.01}) {
    Tracking run(config);
    run.tracker.start(50, 50, 0, 0);
    run.step({});
    run.step({{static_cast<float>(50 + share * edge), 50, kBright}});
    const double x = run.last().at(0).x;
    if (share < 1) {
      EXPECT_GT(x, 52);
    } else {
      EXPECT_EQ(x, 50);
    }
  }
}

TEST(ImmPdaAi, ClutterDensityIsThePointsOverTheArea) {
  const auto text = [](double density) {
    ImmPdaAiConfig config;
    config.clutter_density = density;
    config.start_amplitude = 5;
    Tracking run(config);
    for (int k = 0; k < 8; ++k) {
      const auto x = static_cast<float>(k);
      run.step({{20 + x, 50, 9}, {23 + x, 51, 3}, {70, 10, 3}, {80, 90, 3}, {18 + x, 48, 3}});
    }
    return run.log.text();
  };
  EXPECT_EQ(text(0), text(5e-4));  // five points in 100x100 pixels
  EXPECT_NE(text(0), text(5e-3));
}

ImmPdaAiConfig life_config() {
  ImmPdaAiConfig c;
  c.life = {.confirm_hits = 3, .confirm_window = 4, .halt_misses = 3};
  return c;
}

/// A still target, seen in the frames that are marked x; its reported status by frame: t(entative),
/// c(onfirmed), h(alted), or - for nothing.
std::string life(const ImmPdaAiConfig& config, const std::string& seen, float amplitude = kBright) {
  Tracking run(config);
  std::string reported;
  for (const char mark : seen) {
    run.step(mark == 'x' ? Points{{50, 50, amplitude}} : Points{});
    reported += run.last().empty() ? '-' : "tch"[static_cast<int>(run.last()[0].status)];
  }
  return reported;
}

TEST(ImmPdaAi, ConfirmsATrackSeenOftenEnoughInItsWindow) {
  EXPECT_EQ(life(life_config(), "xxxx"), "ttcc");
  EXPECT_EQ(life(life_config(), "x.xx"), "tttc");
  EXPECT_EQ(life(life_config(), "x..x"), "ttt-");
  ImmPdaAiConfig at_once = life_config();
  at_once.life.confirm_hits = at_once.life.confirm_window = 1;
  EXPECT_EQ(life(at_once, "xx"), "cc");
}

TEST(ImmPdaAi, HaltsAConfirmedTrackAfterMissesInARow) {
  EXPECT_EQ(life(life_config(), "xxx..x...--"), "ttcccccch--");
}

TEST(ImmPdaAi, AHaltedTrackEndsWhereItWasSeenLast) {
  Tracking run(life_config());
  for (int k = 0; k < 8; ++k) run.step(k < 4 ? Points{{50, 50, kBright}} : Points{});
  ASSERT_EQ(run.log.revised().size(), 4u);
  EXPECT_EQ(run.log.revised().back().frame, 3);
}

TEST(ImmPdaAi, StartsFromBrightPointsAlone) {
  EXPECT_EQ(life(life_config(), "xx", 5), "tt");
  EXPECT_EQ(life(life_config(), "xx", 4.99F), "--");
  ImmPdaAiConfig never = life_config();
  never.initiate = false;
  EXPECT_EQ(life(never, "xx"), "--");
}

TEST(ImmPdaAi, OfTwoBrightPointsOfOneTargetTheBrighterStarts) {
  Tracking run(life_config());
  run.step({{50, 50, 7}, {53, 50, 8}, {59.5F, 50, 7}});
  ASSERT_EQ(run.last().size(), 2u);
  EXPECT_EQ(run.last()[0].x, 53);
  EXPECT_EQ(run.last()[1].x, 59.5);
}

/// Identities left after two targets have crossed at right angles at frame 15, and how far the
/// first two are from their targets.
Tracking crossing(double separation) {
  ImmPdaAiConfig config;
  config.amplitude = AmplitudeModel::none;
  config.separation = separation;
  Tracking run(config);
  run.tracker.start(20, 35, 2, 1);
  run.tracker.start(20, 65, 2, -1);
  for (int k = 0; k <= 30; ++k) {
    const auto t = static_cast<float>(k);
    Points points{{20 + 2 * t, 35 + t, kBright}};
    if (k != 15) points.push_back({20 + 2 * t, 65 - t, kBright});  // there they are one
    run.step(points);
  }
  return run;
}

TEST(ImmPdaAi, TargetsThatCrossKeepTheirIdentities) {
  const Tracking run = crossing(0);
  ASSERT_EQ(run.last().size(), 2u);
  for (int i : {0, 1}) {
    const TrackPoint p = run.last()[static_cast<std::size_t>(i)];
    EXPECT_EQ(p.track_id, i + 1);
    EXPECT_NEAR(p.x, 80, 1);
    EXPECT_NEAR(p.y, i == 0 ? 65 : 35, 1);
  }
}

TEST(ImmPdaAi, OfTwoThatComeCloseTheYoungerEnds) {
  const Tracking run = crossing(6);
  const auto online = run.log.online();
  const auto halt = std::ranges::find(online, TrackStatus::halted, &TrackPoint::status);
  ASSERT_NE(halt, online.end());
  EXPECT_EQ(halt->track_id, 2);
  EXPECT_NEAR(static_cast<double>(halt->frame), 13, 1);  // 30 - 2 k < 6
  EXPECT_EQ(run.last()[0].track_id, 1);
}

// The younger goes on if it alone is confirmed.
TEST(ImmPdaAi, OfTwoThatComeCloseTheConfirmedGoesOn) {
  ImmPdaAiConfig config = life_config();
  config.amplitude = AmplitudeModel::none, config.life.confirm_hits = 4;
  Tracking run(config);
  run.step({{50, 50, kBright}});
  run.tracker.start(51, 50, 0, 0);
  run.step({{50, 50, kBright}});
  run.step({{50, 50, kBright}});
  ASSERT_EQ(run.last().size(), 1u);
  EXPECT_EQ(run.last()[0].track_id, 2);
  EXPECT_EQ(run.last()[0].status, TrackStatus::confirmed);
}

// A known target is as bright as the brightest point of its gate.
TEST(ImmPdaAi, KnownTargetsTakeTheAmplitudeOfTheirPoint) {
  ImmPdaAiConfig config = kalman_config();
  config.gate = 9.21;
  Tracking run(config);
  run.tracker.start(20, 30, 0, 0), run.tracker.start(70, 70, 0, 0);
  run.step({{21, 30, 7}, {19, 30, 9}, {50, 50, 30}});
  EXPECT_EQ(run.last().at(0).intensity, 9);
  EXPECT_EQ(run.last().at(1).intensity, config.start_amplitude);
}

// More points than pixels: there is at most one a pixel.
TEST(ImmPdaAi, ClutterIsNoDenserThanOnePointAPixel) {
  const auto text = [](double density) {
    ImmPdaAiConfig config;
    config.clutter_density = density, config.amplitude = AmplitudeModel::none,
    config.initiate = false;
    ImmPdaAi tracker(config, Device::serial(), 1);
    TrackLog log;
    tracker.start(0.5, 0.5, 0, 0);
    const Points points{{0, 0, 9}, {1, 1, 9}, {0.4F, 0.6F, 9}};  // in 1 px^2
    for (int k = 0; k < 3; ++k) {
      Scan scan;
      scan.frame = k, scan.points = points;
      tracker.step(scan, log);
    }
    return log.text();
  };
  EXPECT_EQ(text(0), text(1));
}

/// 50x50 pixels of grey level 100 with 5x5 units of these levels in the middle row.
Frame units_frame(const std::vector<float>& levels) {
  Image<float> image(50, 50);
  for (int y = 0; y < 50; ++y) std::fill_n(image.view().row(y), 50, 100.0F);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    for (int y = 25; y < 30; ++y) std::fill_n(image.view().row(y) + 5 + 20 * i, 5, levels[i]);
  }
  return Frame(std::move(image));
}

std::vector<TrackPoint> tracks_of_units(const ImmPdaAiConfig& config, const Frame& frame) {
  ImmPdaAi tracker(config, Device::serial(), 1);
  TrackLog log;
  Scan scan;
  scan.raw = frame;
  tracker.step(scan, log);
  return log.at(0);
}

// P-HPMHT (20): the mean is 101.1, and 1.1 times that 111.2.
TEST(ImmPdaAi, UnitsAbove11TimesTheMeanAreItsPoints) {
  ImmPdaAiConfig config;
  config.points = PointOrigin::units;
  const Frame frame = units_frame({200, 110});
  const auto tracks = tracks_of_units(config, frame);
  ASSERT_EQ(tracks.size(), 1u);
  EXPECT_EQ(tracks[0].x, 7);
  EXPECT_EQ(tracks[0].y, 27);
  EXPECT_EQ(tracks[0].intensity, 100);  // over the median; all other units are alike: sigma is 1
  EXPECT_EQ(tracks[0].var_x, 16);       // (21)
  config.threshold_scale = 1.08;
  const auto lax = tracks_of_units(config, frame);
  ASSERT_EQ(lax.size(), 2u);
  EXPECT_EQ(lax[1].x, 27);
  EXPECT_EQ(lax[1].intensity, 10);
}

// P-HPMHT (23): I_Th is the mean and a tenth of the 99.9 % quantile, 101.1 + 20.
TEST(ImmPdaAi, UnitsAboveTheDisplayedLevelAreItsPoints) {
  ImmPdaAiConfig config;
  config.points = PointOrigin::units, config.threshold = UnitThreshold::displayed,
  config.threshold_scale = 1;
  EXPECT_EQ(tracks_of_units(config, units_frame({200, 110})).size(), 1u);
  EXPECT_EQ(tracks_of_units(config, units_frame({200, 123})).size(), 2u);
  EXPECT_EQ(tracks_of_units(config, units_frame({200, 121})).size(), 1u);
}

TEST(ImmPdaAi, TakesScansWithoutPointsOrFrames) {
  for (const PointOrigin points : {PointOrigin::scan, PointOrigin::units}) {
    ImmPdaAiConfig config;
    config.points = points;
    ImmPdaAi tracker(config, Device::serial(), 1);
    TrackLog log;
    tracker.step(Scan{}, log);
    EXPECT_TRUE(log.online().empty());
  }
}

TEST(ImmPdaAi, RefusesMoreHitsThanItsWindowHolds) {
  ImmPdaAiConfig config;
  config.life.confirm_hits = 6, config.life.confirm_window = 5;
  EXPECT_THROW(ImmPdaAi(config, Device::serial(), 1), ConfigError);
}

}  // namespace
}  // namespace glint
