// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/sensor_window.hpp"

#include <algorithm>
#include <cmath>

#include "glint/engine/state/fields.hpp"

namespace glint {

SensorWindow::SensorWindow(const ImmWindowConfig& config, const PointSensorConfig& points)
    : window_(WithSensor<PositionSensor<2>>{ImmWindow<PositionSensor<2>>(config), {}}) {
  if (points.measurement == MeasuredQuantity::range_azimuth) {
    RangeAzimuth sensor;
    sensor.noise.diagonal() << points.range_sd * points.range_sd,
        points.azimuth_sd * points.azimuth_sd;
    window_ = WithSensor<RangeAzimuth>{ImmWindow<RangeAzimuth>(config), sensor};
  } else {
    std::get<0>(window_).sensor.noise *= points.measurement_variance;
  }
}

void SensorWindow::add(const Imm& bank) {
  std::visit([&](auto& m) { m.window.add(bank); }, window_);
}

void SensorWindow::remove(std::size_t target) {
  std::visit([&](auto& m) { m.window.remove(target); }, window_);
}

MultiscanReport SensorWindow::step(std::span<const Eigen::Vector2d> points,
                                   const Eigen::Vector2d& place, double density, double elapsed) {
  if (auto* positions = std::get_if<0>(&window_)) {
    return positions->window.step(points, positions->sensor, density, elapsed);
  }
  auto& [window, sensor] = std::get<1>(window_);
  sensor.place = place;
  measurements_.clear();
  double range = 0;
  for (const Eigen::Vector2d& point : points) {
    measurements_.push_back(expected_measurement(sensor, point));
    range += measurements_.back()(0);
  }
  // At range r a square pixel is 1/r wide in azimuth: the density is scaled by the points' mean r,
  // at least by the noise of a range.
  const double mean = points.empty() ? 0 : range / static_cast<double>(points.size());
  const double range_sd = std::sqrt(sensor.noise(0, 0));
  return window.step(measurements_, sensor, density * std::max(mean, range_sd), elapsed);
}

const Imm& SensorWindow::estimate(std::size_t target) const {
  return std::visit([&](const auto& m) -> const Imm& { return m.window.estimate(target); },
                    window_);
}

double SensorWindow::missed(std::size_t target) const {
  return std::visit([&](const auto& m) { return m.window.missed(target); }, window_);
}

std::span<const std::uint32_t> SensorWindow::gated(std::size_t target) const {
  return std::visit([&](const auto& m) { return m.window.gated(target); }, window_);
}

std::span<const double> SensorWindow::shares(std::size_t target) const {
  return std::visit([&](const auto& m) { return m.window.shares(target); }, window_);
}

std::size_t SensorWindow::targets() const {
  return std::visit([](const auto& m) { return m.window.targets(); }, window_);
}

// The sensor is that of the settings, and its place comes with every scan.
void SensorWindow::put_to(ByteWriter& to) const {
  std::visit([&](const auto& m) { put_bytes(to, m.window); }, window_);
}

void SensorWindow::take_from(ByteReader& from) {
  std::visit([&](auto& m) { take_bytes(from, m.window); }, window_);
}

void SensorWindow::require_alike(const Imm& bank) const {
  std::visit([&](const auto& m) { m.window.require_alike(bank); }, window_);
}

Eigen::Matrix2d SensorWindow::noise_at(const Eigen::Vector2d& position,
                                       const Eigen::Vector2d& place) const {
  if (const auto* positions = std::get_if<0>(&window_)) return positions->sensor.noise;
  RangeAzimuth sensor = std::get<1>(window_).sensor;
  sensor.place = place;
  return inverse_measurement(sensor, expected_measurement(sensor, position)).covariance;
}

}  // namespace glint
