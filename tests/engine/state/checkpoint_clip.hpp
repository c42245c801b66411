// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "glint/engine/scenario/scenario.hpp"
#include "glint/engine/trackers/registry.hpp"

namespace glint::test {

/// A tracker, the frames' settings and what else a checkpoint may depend on.
struct CheckpointCase {
  std::string tracker;
  std::vector<std::pair<std::string, std::string>> settings{};  ///< key, value
  FramesConfig frames{};
  bool points_alone = false;  ///< no pixels: points of a detector
  bool bytes = false;         ///< pixels of 8 bits

  friend void PrintTo(const CheckpointCase& c, std::ostream* out) {
    *out << c.tracker;
    for (const auto& [key, value] : c.settings) *out << ' ' << key << '=' << value;
    *out << " background " << static_cast<int>(c.frames.background)
         << (c.points_alone ? " points" : "");
  }
};

/// Targets are born, cross, turn and die, before noise; one is seen again after a gap.
inline Scene checkpoint_scene() {
  Scene scene;
  scene.width = 48, scene.height = 40, scene.frames = 26, scene.interval = 0.5;
  scene.point_spread = PointSpread::of(1);
  scene.noise_sigma = 6, scene.jitter_sigma = 0.2;
  const double bright = 6 * scene.point_spread.intensity_of_snr(17);
  scene.targets = {{0, 26, bright, fly({6, 8, 3, 1.6})},
                   {2, 20, bright, fly({42, 9, -3, 1.5})},
                   {6, 13, bright, fly({10, 32, 2.4, 0})},
                   {15, 26, bright, fly({19, 32, 2.4, -0.5})}};
  scene.background = Image<float>(48, 40);
  const ImageView<float> sky = scene.background.view();
  for (int y = 0; y < sky.height; ++y) {
    for (int x = 0; x < sky.width; ++x) sky(x, y) = 24 + 0.02F * static_cast<float>(x + y);
  }
  scene.grey_levels = true;
  return scene;
}

/// One frame of the scene, as the case wants it.
inline SourceFrame checkpoint_frame(const CheckpointCase& c, const Scene& scene, int f) {
  SourceFrame frame;
  frame.time = f * scene.interval;
  if (c.points_alone) {
    frame.points.emplace();
    for (const TruthPoint& t : truth_at(scene, f)) {
      const auto off = [](std::int64_t i) { return 0.3 * static_cast<double>(i % 5 - 2); };
      frame.points->push_back({static_cast<float>(t.x + off(7 * f + 3 * t.track_id)),
                               static_cast<float>(t.y + off(5 * f + t.track_id)), 9});
    }
    frame.points->push_back({static_cast<float>(f * 31 % 48), static_cast<float>(f * 17 % 40), 6});
    frame.sensor_x = f, frame.sensor_y = -20;
    frame.looked = f % 11 != 10;
    return frame;
  }
  const Image<float> image = render(scene, 5, f);
  const auto copy = [&]<class T>(std::shared_ptr<std::vector<T>> pixels) {
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) pixels->push_back(static_cast<T>(image.view()(x, y)));
    }
    frame.pixels = {static_cast<const T*>(pixels->data()), scene.width, scene.height, 1,
                    scene.width};
    frame.owner = std::move(pixels);
  };
  if (c.bytes) {
    copy(std::make_shared<std::vector<std::uint8_t>>());
  } else {
    copy(std::make_shared<std::vector<float>>());
  }
  return frame;
}

inline Scheduler checkpoint_scheduler(const CheckpointCase& c, const Device& device,
                                      std::uint64_t seed = 3) {
  const TrackerEntry& entry = find_tracker(c.tracker);
  ConfigSection section = entry.config();
  std::string toml;
  for (const auto& [key, value] : c.settings) {
    for (ConfigField& field : section.fields()) {
      if (field.key == key) assign_text(field, value);
    }
    toml += key + " = " + value + '\n';
  }
  PointsConfig points;
  points.threshold = 4;
  Scheduler scheduler(device, FramePreparer(c.frames, device), points);
  scheduler.add(entry.make(section, device, seed), c.tracker);
  scheduler.set_settings("[trackers." + c.tracker + "]\n" + toml);
  return scheduler;
}

}  // namespace glint::test
