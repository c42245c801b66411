// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "glint/engine/trackers/pmht/mmpf_pmht.hpp"

namespace glint {
namespace {

void describe_motion(FieldList& f, PmhtConfig& c) {
  f("motion", c.motion,
    {"ca+singer", "ca", "singer", "cv", "ca+ca", "singer+singer", "cv+ca", "cv+singer",
     "cv+ca+singer"},
    "models that a target switches between");
  f("cv_noise", c.cv_noise, 0, 1e18, "px^2/time^3",
    "of constant velocity: power spectral density of the acceleration");
  f("ca_noise", c.ca_noise, 0, 1e18, "px^2/time^4",
    "of constant acceleration: variance by which it jumps at each step");
  f("singer_fading", c.singer_fading, 0, 1e6, "1/time", "rate at which acceleration fades");
  f("singer_variance", c.singer_variance, 0, 1e18, "px^2/time^4", "of that acceleration");
  f("noise_ratio", c.noise_ratio, 1, 1e6, "",
    "of two models of one kind the second has so many times the noise");
  f("stay", c.stay, 0, 1, "", "probability that a target keeps its model from scan to scan");
  f("clock", c.clock, {{"frames", TimeUnit::frames}, {"seconds", TimeUnit::seconds}},
    "unit of time of every setting: seconds for time stamps that are not regular");
}

void describe_association(FieldList& f, PmhtConfig& c) {
  f("measurement_variance", c.measurement_variance, 1e-12, 1e18, "px^2",
    "of a point's position along each axis");
  f("gate", c.gate, 1e-6, 1e9, "px", "half side of the square about a track in which points count");
  f("detection", c.detection, 0.01, 0.9999, "", "probability that a target gives a point");
  f.automatic("clutter_density", c.clutter_density, 0, 1e12, "1/px^2",
              "density of false points; auto is the number of points beyond one a confirmed track, "
              "over the frame's area");
  f("association", c.association,
    {{"per-model", PmhtAssociation::per_model}, {"mixture", PmhtAssociation::mixture}},
    "a model competes for points with the same model of other targets, or the models of a target "
    "together with those of others");
  f("iterations", c.iterations, 1, 10000, "", "most of expectation maximisation a scan");
  f("tolerance", c.tolerance, 0, 1e9, "px", "it ends when nothing moves further");
}

}  // namespace

void describe(FieldList& f, PmhtConfig& c) {
  describe_motion(f, c);
  describe_association(f, c);
  describe(f, static_cast<PointTrackConfig&>(c));
}

void describe(FieldList& f, MmpfPmhtConfig& c) {
  describe(f, static_cast<PmhtConfig&>(c));
  f("particles", c.particles, 1, 1000000, "", "of each model of a target");
}

namespace {

/// "ca+singer" to {"ca", "singer"}.
std::vector<std::string> parts_of(const std::string& motion) {
  std::vector<std::string> parts{""};
  for (const char letter : motion) {
    if (letter == '+') {
      parts.emplace_back();
    } else {
      parts.back() += letter;
    }
  }
  return parts;
}

/// Of one axis: position, velocity and acceleration at the start, and their covariance. For R = 9,
/// speed_max = 20 and a step of 1 it is the [[9,9,0],[9,18,0],[0,0,4]] of the paper's clips.
Gaussian<3> axis_start(double position, double velocity, const PmhtStart& start,
                       const PmhtConfig& config) {
  constexpr double kSteps = 10;  // in which a new target may gain its largest speed
  const double r = config.measurement_variance, step = start.step;
  const double acceleration = config.speed_max / (kSteps * step);
  Gaussian<3> axis;
  axis.mean << position, velocity, 0;
  axis.covariance << r, r / step, 0, r / step, 2 * r / (step * step), 0, 0, 0,
      acceleration * acceleration;
  if (start.position_variance > 0) axis.covariance(0, 0) = start.position_variance;
  if (start.velocity_variance > 0) axis.covariance(1, 1) = start.velocity_variance;
  if (start.position_variance > 0 || start.velocity_variance > 0) {
    axis.covariance(0, 1) = axis.covariance(1, 0) = 0;
  }
  return axis;
}

template <class Model>
Mode<Model> mode_at(const Model& model, const Gaussian<3>& x, const Gaussian<3>& y) {
  constexpr int kParts = Model::kParts;
  Mode<Model> mode{model, {}};
  mode.belief.mean << x.mean.template head<kParts>(), y.mean.template head<kParts>();
  mode.belief.covariance.setZero();
  mode.belief.covariance.template topLeftCorner<kParts, kParts>() =
      x.covariance.template topLeftCorner<kParts, kParts>();
  mode.belief.covariance.template bottomRightCorner<kParts, kParts>() =
      y.covariance.template topLeftCorner<kParts, kParts>();
  return mode;
}

}  // namespace

std::vector<std::string> pmht_mode_names(const PmhtConfig& config) {
  std::vector<std::string> names = parts_of(config.motion);
  if (names.size() == 2 && names[0] == names[1]) names[1] += "-agile";
  return names;
}

Imm pmht_bank(const PmhtConfig& config, const PmhtStart& start) {
  const Gaussian<3> x = axis_start(start.position.x(), start.velocity.x(), start, config);
  const Gaussian<3> y = axis_start(start.position.y(), start.velocity.y(), start, config);
  Imm::Modes modes;
  for (const std::string& name : pmht_mode_names(config)) {
    const double scale = name.ends_with("-agile") ? config.noise_ratio : 1;
    if (name.starts_with("cv")) modes.push_back(mode_at(ConstantVelocity{config.cv_noise}, x, y));
    if (name.starts_with("ca")) {
      modes.push_back(mode_at(WienerAcceleration{scale * config.ca_noise}, x, y));
    }
    if (name.starts_with("singer")) {
      modes.push_back(mode_at(Singer{config.singer_fading, scale * config.singer_variance}, x, y));
    }
  }
  const std::size_t count = modes.size();
  ModeProbability probability;
  for (std::size_t i = 0; i < count; ++i) probability.push_back(1.0 / static_cast<double>(count));
  return {modes, staying(count, config.stay), probability};
}

}  // namespace glint
