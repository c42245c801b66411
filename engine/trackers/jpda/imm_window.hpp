// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>

#include "glint/engine/trackers/jpda/imm_multiscan_jpda.hpp"
#include "glint/engine/trackers/jpda/imm_window_config.hpp"
#include "glint/engine/trackers/jpda/window_restarts.hpp"

namespace glint {

/// Targets followed together, each by a bank of motion models, with joint probabilistic data
/// association over one scan or a window of scans: P-JPDA section 4, for all ways of
/// reading the window. The library has it for the sensors of the plane; code that uses another
/// sensor compiles its own.
template <class Sensor>
class ImmWindow {
 public:
  using Bank = ImmOf<Sensor::kAxes>;

  explicit ImmWindow(const ImmWindowConfig& config);

  /// A target as it is now: the next scan moves it.
  void add(const Bank& bank);
  void remove(std::size_t target);
  std::size_t targets() const;

  /// The next scan, `elapsed` [time] after the last one. `clutter_density`: false points per volume
  /// of measurements, not used if any number of them is as likely as any other.
  MultiscanReport step(std::span<const Measurement<Sensor>> points, const Sensor& sensor,
                       double clutter_density, double elapsed);

  /// What is known of a target after the last scan.
  const Bank& estimate(std::size_t target) const;
  /// Of the last scan, by the number that the target had then: the probability that it has none
  /// of the scan's points; the numbers of the points in its gate, and the probability that it has
  /// each of them.
  double missed(std::size_t target) const { return filter_.missed(target); }
  std::span<const std::uint32_t> gated(std::size_t target) const { return filter_.gated(target); }
  std::span<const double> shares(std::size_t target) const { return filter_.shares(target); }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.filter_, s.restarts_);
  }
  void restored() const;
  /// Throws BytesError unless all banks are of the models of `bank`.
  void require_alike(const Bank& bank) const;

 private:
  bool restart_;
  ImmMultiscanJpda<Sensor> filter_;
  WindowRestarts<Sensor> restarts_;  // holds the targets if `restart_`, else filter_ does
  SensorScan<Sensor> scan_;
};

template <class Sensor>
ImmWindow<Sensor>::ImmWindow(const ImmWindowConfig& config)
    : restart_(config.reading == WindowReading::restart),
      filter_(config),
      restarts_(config.window) {}

template <class Sensor>
void ImmWindow<Sensor>::add(const Bank& bank) {
  if (restart_) return restarts_.add(bank);
  filter_.add(bank);
}

template <class Sensor>
void ImmWindow<Sensor>::remove(std::size_t target) {
  if (restart_) return restarts_.remove(target);
  filter_.remove(target);
}

template <class Sensor>
std::size_t ImmWindow<Sensor>::targets() const {
  return restart_ ? restarts_.targets() : filter_.targets();
}

template <class Sensor>
MultiscanReport ImmWindow<Sensor>::step(std::span<const Measurement<Sensor>> points,
                                        const Sensor& sensor, double clutter_density,
                                        double elapsed) {
  scan_.points.assign(points.begin(), points.end());
  scan_.sensor = sensor, scan_.clutter_density = clutter_density, scan_.elapsed = elapsed;
  if (restart_) return restarts_.process(filter_, scan_);
  const MultiscanReport report = filter_.process(scan_);
  filter_.advance();
  return report;
}

template <class Sensor>
const ImmOf<Sensor::kAxes>& ImmWindow<Sensor>::estimate(std::size_t target) const {
  return restart_ ? restarts_.estimate(target) : filter_.estimate(target);
}

template <class Sensor>
void ImmWindow<Sensor>::restored() const {
  require_bytes(restart_ ? filter_.targets() == 0 : restarts_.targets() == 0,
                "a window is read in another way");
}

template <class Sensor>
void ImmWindow<Sensor>::require_alike(const Bank& bank) const {
  filter_.require_alike(bank), restarts_.require_alike(bank);
}

extern template class ImmWindow<PositionSensor<2>>;
extern template class ImmWindow<RangeAzimuth>;

}  // namespace glint
