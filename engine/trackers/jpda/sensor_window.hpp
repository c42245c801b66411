// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <variant>
#include <vector>

#include "glint/engine/state/bytes.hpp"
#include "glint/engine/trackers/jpda/imm_window.hpp"

namespace glint {

/// How good points are, along the axes or along and across the sensor's line of sight.
struct PointNoise {
  bool polar = false;
  double variance = 1;                     ///< [px^2] along each axis; unless polar
  double range_sd = 1, azimuth_sd = 0.01;  ///< [px], [rad]; if polar
};

/// An ImmWindow over points that are given by their positions, whatever their sensor measures: the
/// position, or range and azimuth from where it stands.
class SensorWindow {
 public:
  SensorWindow(const ImmWindowConfig& config, const PointNoise& noise);

  void add(const Imm& bank);
  void remove(std::size_t target);
  /// `place` of the sensor [px]; `density` of false points [1/px^2].
  MultiscanReport step(std::span<const Eigen::Vector2d> points, const Eigen::Vector2d& place,
                       double density, double elapsed);

  const Imm& estimate(std::size_t target) const;
  double missed(std::size_t target) const;
  std::span<const std::uint32_t> gated(std::size_t target) const;
  std::span<const double> shares(std::size_t target) const;
  /// Covariance of a point at `position` [px^2].
  Eigen::Matrix2d noise_at(const Eigen::Vector2d& position) const;
  std::size_t targets() const;

  /// For checkpoints: into a window of the same settings. `bank` has the models of all targets.
  void put_to(ByteWriter& to) const;
  void take_from(ByteReader& from);
  void require_alike(const Imm& bank) const;

 private:
  /// A window and its sensor.
  template <class Sensor>
  struct Measured {
    ImmWindow<Sensor> window;
    Sensor sensor;
  };
  std::variant<Measured<PositionSensor<2>>, Measured<RangeAzimuth>> measured_;
  std::vector<Eigen::Vector2d> seen_;
};

}  // namespace glint
