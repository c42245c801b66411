// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "glint/engine/config.hpp"
#include "glint/engine/scenario/path.hpp"
#include "glint/engine/scenario/silhouette.hpp"
#include "glint/engine/scenario/truth.hpp"
#include "glint/engine/scheduler.hpp"
#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/point_spread.hpp"

namespace glint {

/// A target of a scene.
struct ScriptedTarget {
  int birth = 0, death = 0;  ///< seen in frames birth <= frame < death, counted from 0
  double intensity = 0;      ///< total over the point spread, in the units of the pixels
  Path path;
  std::shared_ptr<const Silhouette> silhouette{};  ///< extended, in place of the point spread
};

/// A simulated sequence: everything that follows is a function of the scene, a seed and the frame.
/// Coordinates are Glint's: (0,0) is the centre of the top-left pixel. The papers' cells [i-1,i]
/// with centres i - .5 are shifted: x = x_paper - .5; so are frame numbers: frame = paper - 1.
struct Scene {
  std::string name;
  int width = 0, height = 0;  ///< [px]
  int frames = 0;
  double interval = 1;  ///< [s] between frames
  PointSpread point_spread;
  double noise_sigma = 1;   ///< white Gaussian, a pixel
  double jitter_sigma = 0;  ///< [px] of each target's image about its truth, drawn anew every frame
  std::vector<ScriptedTarget> targets;
  Image<float> background;   ///< empty = zero
  bool grey_levels = false;  ///< round and clamp to 0..255, as an 8-bit camera does
};

/// The targets alive at `frame`, by id; ids count from 0 in the order of the targets.
std::vector<TruthPoint> truth_at(const Scene& scene, int frame);
/// The same for all frames, by frame, then by id.
std::vector<TruthPoint> truth_of(const Scene& scene);
/// What the sensor sees at `frame`: background, targets (pixel-integrated Gaussian or silhouette,
/// jittered), noise.
Image<float> render(const Scene& scene, std::uint64_t seed, int frame);

/// What target `id` covers at `frame` (it must be alive then, and extended), without jitter.
Patch patch_at(const Scene& scene, std::size_t id, int frame);

/// How a scene is found by name, configured and made.
struct SceneEntry {
  std::string_view name, summary;
  ConfigSection (*config)();  ///< its defaults, section "scenes.<name>"
  /// `config` is a section that `config()` made.
  Scene (*make)(const ConfigSection& config);
};

/// The one list of scenes.
std::span<const SceneEntry> all_scenes();
/// Throws ConfigError that lists the names, those of radar_scenes.hpp too, if there is no such
/// scene, and says how to use one that has no frames.
const SceneEntry& find_scene(std::string_view name);

/// A scene's frames, float, one channel.
class SceneSource : public Source {
 public:
  SceneSource(Scene scene, std::uint64_t seed) : scene_(std::move(scene)), seed_(seed) {}
  std::optional<SourceFrame> next() override;
  std::optional<std::int64_t> frame_count() const override { return scene_.frames; }
  double frame_rate() const override { return 1 / scene_.interval; }
  const Scene& scene() const { return scene_; }

 private:
  Scene scene_;
  std::uint64_t seed_;
  int frame_ = 0;
};

}  // namespace glint
