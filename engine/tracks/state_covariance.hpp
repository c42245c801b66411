// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <limits>
#include <string_view>
#include <tuple>

namespace glint {

/// Covariance of position and velocity: the upper triangle of that of (x, y, vx, vy). NaN where it
/// is not known.
struct StateCovariance {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  double var_x = kUnknown, cov_xy = kUnknown, var_y = kUnknown;       ///< [px^2]
  double cov_x_vx = kUnknown, cov_x_vy = kUnknown;                    ///< [px^2/s]
  double cov_y_vx = kUnknown, cov_y_vy = kUnknown;                    ///< [px^2/s]
  double var_vx = kUnknown, cov_vx_vy = kUnknown, var_vy = kUnknown;  ///< [px^2/s^2]

  static StateCovariance zero() { return {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}; }
  /// Of velocities that are `scale` times as large.
  StateCovariance with_velocity_scaled(double scale) const {
    const double square = scale * scale;
    return {var_x,
            cov_xy,
            var_y,
            scale * cov_x_vx,
            scale * cov_x_vy,
            scale * cov_y_vx,
            scale * cov_y_vy,
            square * var_vx,
            square * cov_vx_vy,
            square * var_vy};
  }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.var_x, s.cov_xy, s.var_y, s.cov_x_vx, s.cov_x_vy, s.cov_y_vx, s.cov_y_vy,
                    s.var_vx, s.cov_vx_vy, s.var_vy);
  }
};

/// The parts that velocity has a share in, in the order of fields(): as files name them.
inline constexpr std::array<std::string_view, 7> kVelocityCovarianceNames{
    "cov_x_vx", "cov_x_vy", "cov_y_vx", "cov_y_vy", "var_vx", "cov_vx_vy", "var_vy"};
inline std::array<double, 7> velocity_covariance(const StateCovariance& c) {
  return {c.cov_x_vx, c.cov_x_vy, c.cov_y_vx, c.cov_y_vy, c.var_vx, c.cov_vx_vy, c.var_vy};
}

}  // namespace glint
