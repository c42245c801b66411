// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "glint/engine/scenario/point_sensor.hpp"
#include "glint/engine/scenario/scenario.hpp"

namespace glint::bench {

/// Forty targets that wave to and fro over 1024x256 pixels for ever at up to 7 px/frame and cross,
/// and false points in `percent` of the pixels: scans of points alone, `count` of them.
class EndlessPoints : public Source {
 public:
  explicit EndlessPoints(std::int64_t count, double percent = 0.02);
  std::optional<SourceFrame> next() override;
  std::optional<std::int64_t> frame_count() const override { return count_; }
  /// Where the targets are at the first scan.
  std::vector<Kinematics> starts() const;

 private:
  Scene scene_;
  PointSensor sensor_;
  std::int64_t count_, at_ = 0;
};

}  // namespace glint::bench
