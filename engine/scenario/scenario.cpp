// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/scenario/scenario.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

void start_with_background(const Scene& scene, ImageView<float> out) {
  if (scene.background.width() == 0) return;
  const FrameView from = scene.background.view();
  for (int y = 0; y < out.height; ++y) std::copy_n(from.row(y), out.width, out.row(y));
}

/// The point spread with tails far beyond any tracker's window.
void add_target(const PointSpread& psf, const TruthPoint& target, ImageView<float> out) {
  const int reach = static_cast<int>(std::ceil(6 * psf.sigma)) + 1;
  const int cx = static_cast<int>(std::lround(target.x));
  const int cy = static_cast<int>(std::lround(target.y));
  for (int y = std::max(0, cy - reach); y <= std::min(out.height - 1, cy + reach); ++y) {
    const double row = target.intensity * psf.weight(y - cy, target.y - cy);
    for (int x = std::max(0, cx - reach); x <= std::min(out.width - 1, cx + reach); ++x) {
      out(x, y) += static_cast<float>(row * psf.weight(x - cx, target.x - cx));  // P-PHD (4)
    }
  }
}

Patch patch_of(const Scene& scene, std::size_t id, const TruthPoint& at) {
  const ScriptedTarget& target = scene.targets[id];
  return target.silhouette->at(static_cast<double>(at.frame - target.birth),
                               {at.x, at.y, at.vx, at.vy});
}

/// Pixels are counted row by row; four in a row share the address pixel / 4.
void add_noise(double sigma, RandomKey key, ImageView<float> out) {
  if (sigma == 0) return;
  const auto scale = static_cast<float>(sigma);
  Normals4 noise{};
  std::uint32_t pixel = 0;
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x, ++pixel) {
      if (pixel % 4 == 0) noise = random_normals(key, pixel / 4);
      out(x, y) += scale * noise.n[pixel % 4];
    }
  }
}

void round_to_grey_levels(ImageView<float> out) {
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      out(x, y) = std::clamp(std::nearbyint(out(x, y)), 0.0f, 255.0f);
    }
  }
}

}  // namespace

std::vector<TruthPoint> truth_at(const Scene& scene, int frame) {
  std::vector<TruthPoint> truth;
  for (std::size_t id = 0; id < scene.targets.size(); ++id) {
    const ScriptedTarget& target = scene.targets[id];
    if (frame < target.birth || frame >= target.death) continue;
    const Kinematics k = target.path((frame - target.birth) * scene.interval);
    truth.push_back({frame, static_cast<std::int64_t>(id), k.x, k.y, k.vx, k.vy, target.intensity});
  }
  return truth;
}

std::vector<TruthPoint> truth_of(const Scene& scene) {
  std::vector<TruthPoint> all;
  for (int frame = 0; frame < scene.frames; ++frame) {
    const std::vector<TruthPoint> now = truth_at(scene, frame);
    all.insert(all.end(), now.begin(), now.end());
  }
  return all;
}

Patch patch_at(const Scene& scene, std::size_t id, int frame) {
  const ScriptedTarget& target = scene.targets.at(id);
  const Kinematics k = target.path((frame - target.birth) * scene.interval);
  return target.silhouette->at(frame - target.birth, k);
}

Image<float> render(const Scene& scene, std::uint64_t seed, int frame) {
  Image<float> image(scene.width, scene.height);
  start_with_background(scene, image.view());
  const RandomKey jitter = random_key(seed, frame, Purpose::scenario);
  for (TruthPoint target : truth_at(scene, frame)) {
    const Normals4 n = random_normals(jitter, static_cast<std::uint32_t>(target.track_id));
    target.x += scene.jitter_sigma * n.n[0];
    target.y += scene.jitter_sigma * n.n[1];
    const auto id = static_cast<std::size_t>(target.track_id);
    if (scene.targets[id].silhouette) {
      paint(patch_of(scene, id, target), image.view());
    } else {
      add_target(scene.point_spread, target, image.view());
    }
  }
  add_noise(scene.noise_sigma, random_key(seed, frame, Purpose::sensor_noise), image.view());
  if (scene.grey_levels) round_to_grey_levels(image.view());
  return image;
}

std::optional<SourceFrame> SceneSource::next() {
  if (frame_ >= scene_.frames) return std::nullopt;
  auto image = std::make_shared<const Image<float>>(render(scene_, seed_, frame_));
  const FrameView view = image->view();
  const double time = frame_++ * scene_.interval;
  return SourceFrame{
      {view.data, view.width, view.height, 1, view.pitch}, std::move(image), time, {}};
}

}  // namespace glint
