// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <variant>
#include <vector>

#include "glint/engine/state/bytes.hpp"
#include "glint/engine/trackers/jpda/imm_window.hpp"

namespace glint {

enum class MeasuredQuantity { position, range_azimuth };

/// Settings of a sensor: how its points scatter about the targets.
struct PointSensorConfig {
  MeasuredQuantity measurement = MeasuredQuantity::position;
  double measurement_variance = 1;  ///< of a position along each axis [px^2]
  double range_sd = 4.5;            ///< [px]; along the line of sight from the sensor
  double azimuth_sd = 0.03;         ///< [rad]; across it
};

/// An ImmWindow of points that are given by their positions, whatever their sensor measures: the
/// position itself, or range and azimuth from the sensor's place.
class SensorWindow {
 public:
  SensorWindow(const ImmWindowConfig& config, const PointSensorConfig& points);

  void add(const Imm& bank);
  void remove(std::size_t target);
  /// The next scan, `elapsed` [time] after the last one. `place`: of the sensor [px]; `density`: of
  /// false points [1/px^2].
  MultiscanReport step(std::span<const Eigen::Vector2d> points, const Eigen::Vector2d& place,
                       double density, double elapsed);

  /// As of ImmWindow.
  const Imm& estimate(std::size_t target) const;
  double missed(std::size_t target) const;
  std::span<const std::uint32_t> gated(std::size_t target) const;
  std::span<const double> shares(std::size_t target) const;
  /// Covariance of a point at `position` that is seen from `place` [px^2].
  Eigen::Matrix2d noise_at(const Eigen::Vector2d& position, const Eigen::Vector2d& place) const;
  std::size_t targets() const;

  /// For checkpoints: into a window of the same settings. `bank` has the models of all targets.
  void put_to(ByteWriter& to) const;
  void take_from(ByteReader& from);
  void require_alike(const Imm& bank) const;

 private:
  template <class Sensor>
  struct WithSensor {
    ImmWindow<Sensor> window;
    Sensor sensor;
  };
  std::variant<WithSensor<PositionSensor<2>>, WithSensor<RangeAzimuth>> window_;
  std::vector<Eigen::Vector2d> measurements_;
};

}  // namespace glint
