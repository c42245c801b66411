// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <tuple>

#include "glint/engine/scan.hpp"
#include "glint/engine/state/bytes.hpp"

namespace glint {

/// The unit of time of a tracker's settings.
enum class TimeUnit { frames, seconds };

/// When a step happens.
struct StepTime {
  std::int64_t frame = 0;
  double time = 0;            ///< [s]
  double step = 1;            ///< frames since the last one
  double velocity_scale = 1;  ///< px a frame to px/s

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.frame, s.time, s.step, s.velocity_scale);
  }
  void restored() const { require_frame_number(frame); }
};

/// Tells each scan's step from the scan before; the first counts as one frame of one second.
class StepClock {
 public:
  bool started() const { return frame_ >= 0; }
  StepTime tick(const Scan& scan) {
    StepTime at{scan.frame, scan.time};
    if (started()) {
      at.step = static_cast<double>(scan.frame - frame_);
      const double seconds = scan.time - time_;
      if (seconds > 0) at.velocity_scale = at.step / seconds;
    }
    frame_ = scan.frame, time_ = scan.time;
    return at;
  }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.frame_, s.time_);
  }
  void restored() const { require_frame_number(frame_); }

 private:
  std::int64_t frame_ = -1;
  double time_ = 0;  // [s]
};

}  // namespace glint
