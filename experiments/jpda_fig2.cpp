// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "glint/engine/trackers/jpda/imm_window.hpp"
#include "glint/experiments/jpda.hpp"
#include "glint/experiments/monte_carlo.hpp"
#include "glint/experiments/radar.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

using Window = ImmWindow<RangeAzimuthElevation>;
constexpr int kScans = 35;              // 1 s apart
constexpr int kFirst = 16, kLast = 25;  // scans that errors are compared over
constexpr double kLost = 300;           // [m] from every target at the end
constexpr double kDetection = 0.997;
constexpr double kClutter = 0.1;  // [1/(m rad^2)]
constexpr std::size_t kTargets = 3;

/// P-JPDA section 5: straight on, a turn from 15 to 25 s, straight on.
struct Path {
  Eigen::Vector3d start, velocity;  // [m], [m/s]
  double rate;                      // [rad/s]
};
const std::array<Path, kTargets> kPaths{{{{10500, 1740, 40}, {-140, 299.9, 0}, -0.32},
                                         {{9800, 1960, 40}, {0, 299, 0}, 0.32},
                                         {{9200, 1740, 40}, {0, 299, 0}, 0}}};

Eigen::Vector3d turned(const Eigen::Vector3d& v, double angle) {
  return {std::cos(angle) * v.x() - std::sin(angle) * v.y(),
          std::sin(angle) * v.x() + std::cos(angle) * v.y(), v.z()};
}

Eigen::Vector3d place(const Path& path, double time) {
  const double before = std::min(time, 15.0), turning = std::clamp(time - 15, 0.0, 10.0);
  const double after = std::max(time - 25, 0.0), angle = path.rate * turning;
  Eigen::Vector3d at = path.start + before * path.velocity;
  if (path.rate == 0) {
    at += turning * path.velocity;
  } else {  // the velocity, integrated
    at += (turned(path.velocity, angle - std::numbers::pi / 2) -
           turned(path.velocity, -std::numbers::pi / 2)) /
          path.rate;
  }
  return at + after * turned(path.velocity, angle);
}

RangeAzimuthElevation radar() {
  RangeAzimuthElevation sensor;
  sensor.noise = Eigen::Vector3d(400, 49e-6, 4e-6).asDiagonal();  // [m^2], [rad^2]
  return sensor;
}

Eigen::Vector3d normals(const RandomKey& key, std::uint32_t item, std::uint32_t draw) {
  const Normals4 n = random_normals(key, item, draw);
  return {static_cast<double>(n.n[0]), static_cast<double>(n.n[1]), static_cast<double>(n.n[2])};
}

/// False points lie in a box about the targets, far larger than any gate.
void add_clutter(const std::vector<Eigen::Vector3d>& targets, int scan, std::uint64_t seed,
                 std::vector<Eigen::Vector3d>& points) {
  const Eigen::Vector3d margin(1500, 0.15, 0.05);  // [m], [rad]
  Eigen::Vector3d low = targets.front(), high = low;
  for (const Eigen::Vector3d& t : targets) low = low.cwiseMin(t), high = high.cwiseMax(t);
  low -= margin, high += margin;
  const double expected = kClutter * (high - low).prod();
  const RandomKey key = random_key(seed, static_cast<std::uint64_t>(scan), Purpose::clutter);
  double arrived = 0;  // of a Poisson process
  for (std::uint32_t i = 0;; ++i) {
    const Words4 w = random_words(key, i);
    arrived -= std::log(static_cast<double>(uniform(w.w[3])));
    if (arrived > expected) return;
    const Eigen::Vector3d share(static_cast<double>(uniform(w.w[0])),
                                static_cast<double>(uniform(w.w[1])),
                                static_cast<double>(uniform(w.w[2])));
    points.push_back(low + share.cwiseProduct(high - low));
  }
}

std::vector<Eigen::Vector3d> points_at(int scan, std::uint64_t seed) {
  const RangeAzimuthElevation sensor = radar();
  const RandomKey key = random_key(seed, static_cast<std::uint64_t>(scan), Purpose::scenario);
  std::vector<Eigen::Vector3d> targets, points;
  for (std::uint32_t t = 0; t < kTargets; ++t) {
    targets.push_back(expected_measurement(sensor, place(kPaths[t], scan)));
    if (static_cast<double>(uniform(random_words(key, t, 8).w[0])) > kDetection) continue;
    const Eigen::Vector3d sigma = sensor.noise.diagonal().cwiseSqrt();
    points.push_back(targets.back() + sigma.cwiseProduct(normals(key, t, 0)));
  }
  add_clutter(targets, scan, seed, points);
  return points;
}

/// Ours, as the paper refers to another for its models: accelerations of 5, 7.5 and 40 m/s^2, and
/// a start that is known to 50 m, 10 m/s and 10 m/s^2.
ImmOf<3> start_of(const Path& path, std::uint64_t seed, std::uint32_t target) {
  const RandomKey key = random_key(seed, 0, Purpose::scenario);
  const Eigen::Vector3d p = path.start + 50 * normals(key, target, 1);
  const Eigen::Vector3d v = path.velocity + 10 * normals(key, target, 2);
  Gaussian<9> state;
  state.mean << p.x(), v.x(), 0, p.y(), v.y(), 0, p.z(), v.z(), 0;
  const Eigen::Vector3d axis(50. * 50, 10. * 10, 10. * 10);
  state.covariance.diagonal() << axis, axis, axis;
  const Gaussian<6> without = embed<3>(state, Gaussian<6>{});
  Switching switching = Switching::Constant(3, 3, 0.1);
  switching.diagonal().setConstant(0.8);
  return {{Mode<NearlyConstantVelocity, 3>{{5 * 5}, without},
           Mode<WienerAcceleration, 3>{{7.5 * 7.5}, state},
           Mode<WienerAcceleration, 3>{{40 * 40}, state}},
          switching,
          {0.8, 0.1, 0.1}};
}

struct Reading {
  const char* name;
  int scans;
  WindowReading reading;
  std::optional<double> most_lost;  // of the tracks [%]
};
constexpr std::array kReadings{
    Reading{"single scan", 1, WindowReading::sliding, 2.0},
    Reading{"A", 2, WindowReading::restart, {}}, Reading{"C", 2, WindowReading::sliding, {}},
    Reading{"C*", 2, WindowReading::best, 0.5},  // A loses 30 tracks of 6000
};

struct Run {
  double rms = 0, lost = 0;                  // over kFirst to kLast [m]; tracks
  std::array<double, kScans + 1> squares{};  // mean over targets, by scan [m^2]
};

Run follow(const Reading& reading, std::uint64_t seed) {
  ImmWindowConfig config;
  config.window = reading.scans, config.reading = reading.reading;
  config.detection = kDetection, config.gate = 16;
  config.clutter = JpdaClutter::Number::any;
  Window window(config);
  for (std::uint32_t t = 0; t < kTargets; ++t) window.add(start_of(kPaths[t], seed, t));
  Run run;
  double sum = 0;
  for (int k = 1; k <= kScans; ++k) {
    window.step(points_at(k, seed), radar(), 0, 1);
    for (std::size_t t = 0; t < kTargets; ++t) {
      const Eigen::Vector3d at = position_of<3>(window.estimate(t).combined()).mean;
      const double square = (at - place(kPaths[t], k)).squaredNorm();
      run.squares[static_cast<std::size_t>(k)] += square / kTargets;
      sum += k >= kFirst && k <= kLast ? square : 0;
      if (k < kScans) continue;
      run.lost += std::ranges::all_of(
          kPaths, [&](const Path& path) { return (at - place(path, k)).norm() > kLost; });
    }
  }
  run.rms = std::sqrt(sum / (kTargets * (kLast - kFirst + 1)));
  return run;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : values[values.size() / 2];
}

Curve curve_of(const Reading& reading, const std::vector<Run>& runs) {
  Curve curve{"three aircraft", reading.name, "RMSE [m]", {}, {}};
  for (std::size_t k = 1; k <= kScans; ++k) {
    double sum = 0;
    for (const Run& run : runs) sum += run.squares[k];
    curve.frame.push_back(static_cast<double>(k));
    curve.value.push_back(std::sqrt(sum / static_cast<double>(runs.size())));
  }
  return curve;
}

}  // namespace

ExperimentResult run_jpda_fig2(const ExperimentOptions& options, Workers& workers) {
  const auto runs =
      run_cases(kReadings.size(), options, workers, [&](std::size_t which, std::size_t run) {
        return follow(kReadings[which], options.seed + run);
      });
  ExperimentResult result;
  for (std::size_t r = 0; r < kReadings.size(); ++r) {
    const Reading& reading = kReadings[r];
    const std::vector<double> rms = column(runs[r], &Run::rms);
    const std::vector<double> lost = column(runs[r], &Run::lost, 100.0 / kTargets);
    std::vector<double> ratio;
    for (std::size_t i = 0; i < rms.size(); ++i) ratio.push_back(std::log(rms[i] / runs[0][i].rms));
    result.rows.push_back(value_row(reading.name, "run-rms, scans 16-25 [m]", rms));
    result.rows.push_back(value_row(reading.name, "its median [m]", {median(rms)}, Band{71, 78}));
    const auto most = reading.most_lost;
    result.rows.push_back(value_row(reading.name, "tracks lost [%]", lost,
                                    most ? std::optional(Band{{}, *most}) : std::nullopt));
    if (r > 0) {
      const Summary s = summarise(ratio);
      const double error = s.spread / std::sqrt(static_cast<double>(ratio.size()));
      result.rows.push_back(value_row(reading.name, "ln of rms over single scan", ratio));
      result.rows.push_back(value_row(reading.name, "mean + 2 standard errors",
                                      {s.mean + 2 * error},
                                      most ? std::optional(Band{{}, 0.0}) : std::nullopt));
    }
    result.curves.push_back(curve_of(reading, runs[r]));
  }
  return result;
}

}  // namespace glint
