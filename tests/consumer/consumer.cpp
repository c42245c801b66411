// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <utility>
#include <vector>

#include "glint/engine/trackers/registry.hpp"
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"

// Finds one bright target in an otherwise empty frame, and the standard tracker in the registry.
int main() {
  glint::Image<float> frame(64, 48);
  frame.view()(20, 30) = 9;
  std::vector<glint::Hit> hits;
  glint::PixelLikelihood::Args args;
  args.frame = std::as_const(frame).view();
  args.spread = glint::PointSpread::of(0.7);
  args.intensity = static_cast<float>(args.spread.intensity_of_snr(12));
  args.threshold = 5;
  args.hits = &hits;
  glint::Device::tbb().run<glint::PixelLikelihood>(args);

  bool found = false;
  for (const glint::Hit& hit : hits) found = found || (hit.x == 20 && hit.y == 30);
  const bool tracker = glint::find_tracker("smc-phd").make != nullptr;
  std::printf("target %s, tracker %s\n", found ? "found" : "lost", tracker ? "there" : "missing");
  return found && tracker ? 0 : 1;
}
