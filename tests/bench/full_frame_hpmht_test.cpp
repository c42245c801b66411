// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/baselines/full_frame_hpmht.hpp"

#include <gtest/gtest.h>

#include "glint/engine/scenario/scenario.hpp"

namespace glint {
namespace {

TEST(FullFrameHPmht, EstimatesWhatTheTrackerEstimates) {
  Scene scene;
  scene.width = 40, scene.height = 36, scene.frames = 10;
  scene.point_spread = PointSpread::of(1);
  ScriptedTarget target;
  target.death = scene.frames;
  target.intensity = scene.point_spread.intensity_of_snr(14);
  target.path = fly({10, 12, 1.3, 0.7});
  scene.targets.push_back(target);
  for (const bool estimate_extent : {false, true}) {
    HPmhtConfig config;
    config.initiate = false, config.estimate_extent = estimate_extent;
    HPmht tracker(config, Device::serial(), 1);
    tracker.start(10, 12, 1, 1);
    bench::FullFrameHPmht full(config);
    full.start({10, 1, 12, 1});
    TrackLog log;
    for (int k = 0; k < scene.frames; ++k) {
      Scan scan;
      scan.frame = k, scan.time = k;
      scan.whitened = Frame(render(scene, 1, k));
      tracker.step(scan, log);
      if (k == 0) continue;  // the track starts here
      full.step(scan.whitened.view());
      const auto points = log.at(k);
      ASSERT_EQ(points.size(), 1u);
      EXPECT_NEAR(points[0].x, full.state()(0), 1e-4);
      EXPECT_NEAR(points[0].y, full.state()(2), 1e-4);
      EXPECT_NEAR(points[0].vx, full.state()(1), 1e-4);
    }
    EXPECT_GE(full.scan_iterations(), 9);
  }
}

}  // namespace
}  // namespace glint
