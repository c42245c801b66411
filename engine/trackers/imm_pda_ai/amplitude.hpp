// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace glint {

/// Densities of the amplitude [sigma] of points that exceed a threshold. They tell targets and
/// clutter apart by the log ratio of the two densities, both given that the threshold is exceeded.
enum class AmplitudeModel { none, rayleigh, gaussian };

/// ln of the probability that a standard normal exceeds x.
inline double log_normal_tail(double x) {
  if (x < 25) return std::log(std::erfc(x / std::numbers::sqrt2) / 2);
  // Where erfc is about to vanish: Laplace's continued fraction.
  return -x * x / 2 - std::log(x + 1 / (x + 2 / x)) - std::log(2 * std::numbers::pi) / 2;
}

/// The running mean of a target's amplitude.
class TargetAmplitude {
 public:
  TargetAmplitude() = default;
  explicit TargetAmplitude(double first) : mean_(first) {}
  double mean() const { return mean_; }
  /// The next amplitude [sigma], with the probability that it is the target's own.
  void update(double amplitude, double probability) {
    mean_ += 0.2 * probability * (amplitude - mean_);
  }
  double log_ratio(AmplitudeModel model, double amplitude, double threshold) const {
    if (model == AmplitudeModel::none) return 0;
    const double a = std::max(amplitude, threshold);
    return model == AmplitudeModel::rayleigh ? rayleigh(a, threshold) : gaussian(a, threshold);
  }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.mean_);
  }

 private:
  /// Lerro and Bar-Shalom 1993: Rayleigh, of unit power for clutter, of power 1 + d for the target,
  /// whose mean is sqrt(pi (1 + d) / 2).
  double rayleigh(double amplitude, double threshold) const {
    const double t = std::max(threshold, 0.0), a = std::max(amplitude, t);
    const double power = std::max(2 / std::numbers::pi * mean_ * mean_, 1.0);
    return (a * a - t * t) / 2 * (1 - 1 / power) - std::log(power);
  }
  /// Clutter is standard normal; the target is normal about its mean, as wide as an extended
  /// target's parts are uneven.
  double gaussian(double a, double t) const {
    const double spread = std::max(1.0, 0.3 * mean_);
    const double off = (a - mean_) / spread;
    return (a * a - off * off) / 2 - std::log(spread) + log_normal_tail(t) -
           log_normal_tail((t - mean_) / spread);
  }

  double mean_ = 0;
};

}  // namespace glint
