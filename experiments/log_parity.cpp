// SPDX-License-Identifier: Apache-2.0
#include "glint/experiments/log_parity.hpp"

#include <algorithm>

namespace glint {

TrackLog track_log(const TrackerEntry& tracker, const Scene& scene, std::uint64_t seed,
                   const Device& device) {
  Scheduler scheduler(device, FramePreparer(FramesConfig{}, device));
  scheduler.add(tracker.make(tracker.config(), device, seed));
  SceneSource source(scene, seed);
  scheduler.run(source);
  return *scheduler.logs().front();
}

std::size_t first_other_line(const std::string& a, const std::string& b) {
  if (a == b) return 0;
  const auto at = std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first;
  return 1 + static_cast<std::size_t>(std::count(a.begin(), at, '\n'));
}

std::vector<LogParityRow> check_log_parity(const TrackerEntry& tracker, const Scene& scene,
                                           std::uint64_t seed, std::span<const Device> devices) {
  std::vector<LogParityRow> rows;
  std::string first;
  for (const Device& device : devices) {
    const TrackLog log = track_log(tracker, scene, seed, device);
    const std::string text = log.text();
    if (rows.empty()) first = text;
    rows.push_back({std::string(tracker.name), scene.name, device.description(),
                    log.online().size(), first_other_line(first, text)});
  }
  return rows;
}

}  // namespace glint
