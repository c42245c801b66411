// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace glint {

/// What the amplitude a [sigmas] of a point that exceeds a threshold says of its origin: the log
/// ratio of its density for the target to that for clutter, both given that they exceed it.
enum class AmplitudeModel { none, rayleigh, gaussian };

inline AmplitudeModel amplitude_model(const std::string& name) {
  if (name == "rayleigh") return AmplitudeModel::rayleigh;
  return name == "gaussian" ? AmplitudeModel::gaussian : AmplitudeModel::none;
}

/// A target's amplitude as it was so far.
class TargetAmplitude {
 public:
  TargetAmplitude() = default;
  explicit TargetAmplitude(double first) : mean_(first) {}
  double mean() const { return mean_; }
  /// The next amplitude, with the probability that it was the target's own.
  void learn(double amplitude, double probability) {
    mean_ += 0.2 * probability * (amplitude - mean_);
  }
  double log_ratio(AmplitudeModel model, double amplitude, double threshold) const {
    if (model == AmplitudeModel::none) return 0;
    const double a = std::max(amplitude, threshold), t = std::max(threshold, 0.0);
    if (model == AmplitudeModel::rayleigh) {
      // Lerro and Bar-Shalom 1993: Rayleigh of unit power for clutter, of power 1 + d for the
      // target.
      const double power = std::max(mean_ * mean_ / 2, 1.0);
      return (a * a - t * t) / 2 * (1 - 1 / power) - std::log(power);
    }
    // Clutter is the tail of a standard normal, of about exp(-t (a - t)) beyond a high threshold;
    // the target is normal about its mean, as wide as an extended target's parts are uneven.
    const double spread = std::max(1.0, 0.3 * mean_);
    const double off = (a - mean_) / spread;
    return (a * a - t * t) / 2 - off * off / 2 -
           std::log(spread * std::sqrt(2 * std::numbers::pi) * (1 + t));
  }

 private:
  double mean_ = 0;
};

}  // namespace glint
