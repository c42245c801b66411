// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/imm_jpda.hpp"

namespace glint {
namespace {

void describe_motion(FieldList& f, ImmJpdaConfig& c) {
  f("motion", c.motion, {"ncv", "ncv+ncv", "ncv+wpa", "ncv+wpa+wpa"},
    "models that a target switches between: nearly constant velocity, Wiener-process acceleration");
  f("noise", c.noise, 0, 1e9, "px/time^2", "acceleration in a step, of the first model");
  f("noise_agile", c.noise_agile, 0, 1e9, "px/time^2",
    "the same of a second ncv; of the first wpa, what its acceleration changes by in a step");
  f("noise_jump", c.noise_jump, 0, 1e9, "px/time^2", "of the second wpa");
  f("stay", c.stay, 0, 1, "", "probability that a target keeps its model from scan to scan");
  f("clock", c.clock, {{"frames", TimeUnit::frames}, {"seconds", TimeUnit::seconds}},
    "unit of time of every setting: seconds for time stamps that are not regular");
}

void describe_association(FieldList& f, ImmJpdaConfig& c) {
  f("measurement", c.measurement,
    {{"position", MeasuredQuantity::position}, {"range-azimuth", MeasuredQuantity::range_azimuth}},
    "what the sensor measures, and so how its points scatter");
  f("measurement_variance", c.measurement_variance, 1e-12, 1e18, "px^2",
    "of a point's position along each axis, if positions are measured");
  f("range_sd", c.range_sd, 1e-6, 1e9, "px", "spread of a measured range");
  f("azimuth_sd", c.azimuth_sd, 1e-9, 3.2, "rad", "spread of a measured azimuth");
  f("linearisation", c.linearisation,
    {{"ekf", Linearisation::extended}, {"ukf", Linearisation::unscented}},
    "of range and azimuth: extended or unscented Kalman filter");
  f("gate", c.gate, 0.1, 1000, "", "squared distance of a point in sigmas; 13.8 holds 99.9 %");
  f("detection", c.detection, 0.01, 0.9999, "", "probability that a target gives a point");
  f("clutter", c.clutter,
    {{"poisson", JpdaClutter::Number::poisson}, {"any", JpdaClutter::Number::any}},
    "number of false points: Poisson, or any number as likely as any other (nonparametric)");
  f.automatic("clutter_density", c.clutter_density, 0, 1e12, "1/px^2",
              "density of false points if Poisson; auto is the number of points beyond one a "
              "confirmed track, over the frame's area");
  f("window", c.window, 1, 3, "scans", "that are associated together");
  f("reading", c.reading,
    {{"restart", WindowReading::restart},
     {"sliding", WindowReading::sliding},
     {"best", WindowReading::best}},
    "of a window of several scans: from the estimate before it as printed (A), sliding (C), or "
    "sliding with the best permutation of each set of targets and points (C*)");
}

}  // namespace

void describe(FieldList& f, ImmJpdaConfig& c) {
  describe_motion(f, c);
  describe_association(f, c);
  f.automatic("position_sd", c.position_sd, 0, 1e9, "px",
              "spread of the position of a track that is started from a known one; auto is that of "
              "a point");
  f("velocity_sd", c.velocity_sd, 0, 1e9, "px/time", "spread of its velocity");
  describe(f, static_cast<PointTrackConfig&>(c));
}

std::vector<std::string> imm_jpda_modes(const ImmJpdaConfig& config) {
  if (config.motion == "ncv") return {"ncv"};
  if (config.motion == "ncv+ncv") return {"ncv", "ncv-agile"};
  if (config.motion == "ncv+wpa") return {"ncv", "wpa"};
  return {"ncv", "wpa", "wpa-jump"};
}

Imm imm_jpda_bank(const ImmJpdaConfig& config, const Gaussian<4>& state) {
  Imm::Modes modes;
  for (const std::string& name : imm_jpda_modes(config)) {
    const double sd = name == "ncv"        ? config.noise
                      : name == "wpa-jump" ? config.noise_jump
                                           : config.noise_agile;
    if (name.starts_with("ncv")) {
      modes.push_back(Mode<NearlyConstantVelocity>{{sd * sd}, state});
      continue;
    }
    Gaussian<6> own;
    own.covariance *= sd * sd;
    modes.push_back(Mode<WienerAcceleration>{{sd * sd}, embed<2>(state, own)});
  }
  const std::size_t count = modes.size();
  ModeProbability probability;
  for (std::size_t i = 0; i < count; ++i) {  // P-JPDA section 5: .8 .1 .1
    probability.push_back(count == 1 ? 1 : i == 0 ? 0.8 : 0.2 / static_cast<double>(count - 1));
  }
  return {modes, staying(count, config.stay), probability};
}

}  // namespace glint
