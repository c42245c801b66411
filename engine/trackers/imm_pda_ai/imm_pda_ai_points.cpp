// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "glint/engine/frames/intensity_levels.hpp"
#include "glint/engine/trackers/imm_pda_ai/imm_pda_ai.hpp"

namespace glint {

void ImmPdaAi::measure(const Scan& scan) {
  points_.clear(), points_.area.see(scan);
  if (config_.points == PointOrigin::units) return measure_units(scan.raw.view());
  amplitude_threshold_ = std::numeric_limits<double>::infinity();
  for (const PointMeasurement& point : scan.points) {
    // Points whose amplitude is unknown are all alike, and bright enough to start a track.
    const double amplitude =
        std::isnan(point.amplitude) ? config_.start_amplitude : point.amplitude;
    if (!placed(point) || !std::isfinite(amplitude)) continue;
    points_.add({point.x, point.y}, amplitude);
    amplitude_threshold_ = std::min(amplitude_threshold_, amplitude);
  }
}

/// P-HPMHT (20); amplitudes in robust sigmas of all units' means.
void ImmPdaAi::measure_units(FrameView frame) {
  if (frame.empty()) return;
  FindPoints::Args args;
  args.map = frame;
  args.mode = FindPoints::Mode::unit_5x5;
  args.threshold = std::numeric_limits<float>::lowest();
  args.points = &units_;
  args.workspace = &workspace_;
  device_.run<FindPoints>(args);
  const IntensityLevels levels = intensity_levels(frame, levels_);
  const double threshold =
      config_.threshold_scale *
      (config_.threshold == UnitThreshold::mean ? levels.mean : levels.displayed());
  levels_.clear();
  for (const Point& unit : units_) levels_.push_back(unit.amplitude);
  const RobustMoments clutter = robust_moments(levels_);
  const double sigma = clutter.sigma > 0 ? clutter.sigma : 1;
  amplitude_threshold_ = (threshold - clutter.median) / sigma;
  for (const Point& unit : units_) {
    const double mean = static_cast<double>(unit.amplitude);
    if (mean < threshold) continue;
    points_.add({unit.x, unit.y}, (mean - clutter.median) / sigma);
  }
}

/// All points count, those of the targets included; there is at most one where a point scatters.
void ImmPdaAi::set_clutter() {
  const double variance = noise_(0, 0);
  clutter_ = config_.clutter_density > 0
                 ? config_.clutter_density
                 : std::min(points_.false_density(0, variance), 1 / variance);
}

}  // namespace glint
