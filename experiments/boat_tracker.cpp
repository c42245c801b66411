// SPDX-License-Identifier: Apache-2.0
#include "glint/experiments/boat_tracker.hpp"

namespace glint {

ImmJpdaConfig boat_tracker(const JpdaReading& reading) {
  ImmJpdaConfig config;
  config.clock = TimeUnit::seconds;
  config.motion = "ncv+ncv", config.noise = 0.05, config.noise_agile = 0.5, config.stay = 0.95;
  config.measurement_variance = 25;
  config.detection = 0.9, config.gate = 13.8, config.clutter_density = 5e-6;
  config.window = reading.window, config.reading = reading.reading;
  config.position_sd = 8, config.velocity_sd = 1;
  config.speed_max = 15, config.separation = 10;
  return config;
}

}  // namespace glint
