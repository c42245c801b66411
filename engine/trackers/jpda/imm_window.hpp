// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "glint/engine/filters/imm.hpp"
#include "glint/engine/filters/short_list.hpp"
#include "glint/engine/trackers/jpda/measurement_prediction.hpp"
#include "glint/engine/trackers/jpda/multiscan_jpda.hpp"

namespace glint {

/// How a window of scans is gone through.
enum class WindowReading {
  restart,  ///< from the estimate before its first scan, at every scan anew: P-JPDA as printed
  sliding,  ///< what is likely given all earlier scans weighs in; the oldest scan is merged
};

struct ImmWindowSettings {
  int scans = 2;  ///< in the window, 1 to 3; 1 is IMM-JPDA
  WindowReading reading = WindowReading::sliding;
  double detection = 0.9;    ///< P_D
  double gate = 13.8;        ///< squared distance
  MultiscanSettings events;  ///< with the best permutation: C*
  JpdaClutter::Number clutter = JpdaClutter::Number::poisson;
  Linearisation linearisation = Linearisation::tangent;  ///< of a curved measurement
};

/// Targets followed together, each by a bank of motion models: IMM-JPDA over a window of scans,
/// P-JPDA section 4. The gate of a target is the union of those of its models and hypotheses.
template <class Sensor>
class ImmWindow {
 public:
  using Bank = ImmOf<Sensor::kAxes>;
  using Seen = Measurement<Sensor>;
  static constexpr int kMostScans = 3;

  explicit ImmWindow(const ImmWindowSettings& settings)
      : settings_(settings),
        jpda_(settings.scans > 1 ? settings.events : MultiscanSettings::apart()) {}

  /// A target as it is now: the next scan moves it.
  void add(const Bank& bank);
  void remove(std::size_t target);
  std::size_t targets() const { return targets_.size(); }

  /// Takes a scan in, `elapsed` after the last one. `density`: of false points [1/volume].
  MultiscanReport step(std::span<const Seen> points, const Sensor& sensor, double density,
                       double elapsed);

  /// What is known of a target after the last scan.
  const Bank& bank(std::size_t target) const { return targets_[target].estimate; }
  Bank& bank(std::size_t target) { return targets_[target].estimate; }
  /// Probability that it has none of the points of the last scan, or the point of its gate.
  double missed(std::size_t target) const { return targets_[target].missed; }
  std::span<const std::uint32_t> gated(std::size_t target) const {
    return targets_[target].gate.of(gate_);
  }
  std::span<const double> shares(std::size_t target) const {
    return targets_[target].gate.of(shares_);
  }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.jpda_, s.targets_, s.hypotheses_, s.past_, s.active_);
  }
  void restored() const;
  /// Throws BytesError unless all banks are made of the models of `bank`, which are indexed by.
  void require_alike(const Bank& bank) const;

 private:
  /// What the target had in the scans of the window before this one, and where that leads to.
  struct Hypothesis {
    std::array<std::uint32_t, kMostScans - 1> history{};
    int length = 0;
    Bank bank;
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.history, s.length, s.bank);
    }
  };
  /// What a hypothesis becomes with a point: the covariances are the same with every point.
  struct Child {
    using Mean = Eigen::Matrix<double, 3 * Sensor::kAxes, 1>;  // of N numbers the first N
    ModeProbability probability;
    ShortList<Mean, kMostModes> mean;  // by model
  };
  /// Part of an array that holds those of all targets: each array then has the room of the largest
  /// scan, which grows little in time, and not that of each target's largest.
  struct Range {
    std::size_t first = 0, count = 0;
    template <class T>
    std::span<const T> of(const std::vector<T>& all) const {
      return std::span(all).subspan(first, count);
    }
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.first, s.count);
    }
  };
  struct Target {
    Bank estimate;
    std::vector<Bank> before{};  // estimates, the newest last; restart alone
    Range hypotheses{};
    // Of the last scan.
    Range gate{};                 // also of shares_
    Range log_weight{};           // by hypothesis and option
    std::size_t first_child = 0;  // by hypothesis and point
    double volume = 0;            // of the gate
    double missed = 1;
    std::size_t options() const { return gate.count + 1; }
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.estimate, s.before, s.hypotheses);
    }
  };
  struct PastScan {
    std::vector<Seen> points;
    Sensor sensor;
    double density = 0, elapsed = 0;
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.points, s.sensor, s.density, s.elapsed);
    }
  };
  /// A hypothesis of a target with one of its options.
  struct Part {
    std::size_t hypothesis, option;
  };
  struct Parts;

  void check_hypotheses() const;
  MultiscanReport restart(const PastScan& newest);
  MultiscanReport process_scan(const PastScan& scan);
  void remember(const PastScan& scan);
  void begin(std::uint32_t target, const Bank& bank);
  void predict(const Target& target, const PastScan& scan);
  void find_gate(Target& target, const PastScan& scan);
  template <int N>
  void gate_of(const Gaussian<N>& predicted, Target& target, const PastScan& scan);
  void update(const Target& target, const PastScan& scan, std::size_t hypothesis);
  template <int N>
  void update_mode(const Gaussian<N>& predicted, std::size_t mode, std::span<Child> children,
                   const Target& target, const PastScan& scan);
  void estimate(Target& target, std::size_t number);
  void advance();
  void name_merged(const Target& target, int memory);
  void merge(Target& target, std::size_t number, std::span<const std::uint32_t> merged);
  void forget();

  ImmWindowSettings settings_;
  MultiscanJpda jpda_;
  std::vector<Target> targets_;
  std::vector<Hypothesis> hypotheses_;
  std::vector<PastScan> past_;         // the newest last; restart alone
  std::vector<std::uint32_t> active_;  // targets by their number in jpda_, as are hypotheses_
  // Of the last scan, by target.
  PastScan newest_;
  std::vector<std::uint32_t> gate_;
  std::vector<double> shares_, log_weight_;
  std::vector<typename Bank::Modes> updated_;  // by hypothesis: covariances after a point
  std::vector<Child> children_;
  // Memory to be used again.
  std::vector<TargetScan> scan_;
  std::vector<Hypothesis> next_;
  std::vector<bool> gated_;
  std::vector<std::uint32_t> merged_;
  std::vector<Part> parts_;
  std::vector<double> weights_, log_likelihood_;  // log_likelihood_: by point and model
};

extern template class ImmWindow<PositionSensor<2>>;
extern template class ImmWindow<RangeAzimuth>;
extern template class ImmWindow<RangeAzimuthElevation>;

}  // namespace glint
