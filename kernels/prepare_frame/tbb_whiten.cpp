// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/prepare_frame/lanes.hpp"
#include "glint/kernels/prepare_frame/residuals.hpp"
#include "glint/kernels/prepare_frame/streaming.hpp"
#include "glint/kernels/prepare_frame/whiten.hpp"

namespace glint {
namespace {

/// Calls f(x0, x1, y0, y1) for tiles of kTileColumns columns. Higher frames have higher tiles:
/// each tile sweeps over some rows above and below it.
template <class F>
void for_blocks(int width, int height, Workers& workers, const F& f) {
  const auto h = static_cast<std::size_t>(height);
  const Tiles rows{h, std::clamp<std::size_t>(h / 8 / 16 * 16, 64, 256)};
  const Tiles columns{static_cast<std::size_t>(width), kTileColumns};
  workers.for_tiles(rows.tiles() * columns.tiles(), [&](std::size_t t) {
    const std::size_t i = t % columns.tiles(), j = t / columns.tiles();
    f(static_cast<int>(columns.begin(i)), static_cast<int>(columns.end(i)),
      static_cast<int>(rows.begin(j)), static_cast<int>(rows.end(j)));
  });
}

/// The float of a key, as make_keys() makes them.
float value_of(std::int32_t key) {
  const std::int32_t bits = key < 0 ? key ^ 0x7fffffff : key;
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// Median of n > 0 values, the mean of the two middle ones, by bisection on their keys: every step
/// is one vector pass over data in the first caches.
float median_of(const float* values, std::int32_t* keys, int n, const PrepareFrameLanes& lanes) {
  const KeyRange range = lanes.make_keys(values, keys, n);
  std::int64_t low = range.least, high = range.most;
  while (low < high) {
    const std::int64_t middle = low + (high - low) / 2;
    if (lanes.count_up_to(keys, n, static_cast<std::int32_t>(middle)) > (n - 1) / 2) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  const auto lower = static_cast<std::int32_t>(low);
  std::int32_t upper = lower;
  if (lanes.count_up_to(keys, n, lower) <= n / 2) {
    upper = range.most;
    for (int i = 0; i < n; ++i) {
      if (keys[i] > lower && keys[i] < upper) upper = keys[i];
    }
  }
  return (value_of(lower) + value_of(upper)) * 0.5F;
}

float energy_scale(const Whiten::Args& args) {
  const double width = 2.0 * args.ring_outer + 1;
  const double most = width * width * args.ring_clip * args.ring_clip;
  return static_cast<float>(std::exp2(std::floor(std::log2(0x1p30 / most))));
}

}  // namespace

WhitenPass whiten_pass(const Whiten::Args& args) {
  const float scale = energy_scale(args);
  WhitenPass pass{};
  pass.image = args.image.data, pass.image_pitch = args.image.pitch;
  pass.background = args.background.data, pass.background_pitch = args.background.pitch;
  pass.structure = args.structure.empty() ? nullptr : args.structure.data;
  pass.structure_pitch = args.structure.pitch;
  pass.width = args.image.width, pass.height = args.image.height;
  pass.outer = args.ring_outer, pass.inner = args.ring_inner;
  pass.sigma = static_cast<float>(args.sigma);
  pass.inverse_sigma = static_cast<float>(1 / args.sigma);
  pass.energy_scale = scale;
  pass.energy_cap = static_cast<float>(args.ring_clip * args.ring_clip) * scale;
  const bool both = args.polarity == Polarity::both;
  pass.keep_bits = both ? 0x7fffffff : -1;
  pass.flip_bits = args.polarity == Polarity::dark ? INT32_MIN : 0;
  pass.offset = both ? static_cast<float>(std::sqrt(2 / std::numbers::pi)) : 0;
  pass.clip_low = static_cast<float>(args.clip_low);
  pass.clip_high = static_cast<float>(args.clip_high);
  pass.stream = worth_streaming(args.whitened);
  pass.whitened = args.whitened.data, pass.whitened_pitch = args.whitened.pitch;
  pass.noise = args.noise.empty() ? nullptr : args.noise.data;
  pass.noise_pitch = args.noise.pitch, pass.noise_step = args.noise_step;
  return pass;
}

void BackgroundStructure::tbb(const Args& args, Workers& workers) {
  const StructurePass pass{args.background.data,
                           args.background.pitch,
                           args.background.width,
                           args.background.height,
                           args.structure.data,
                           args.structure.pitch,
                           args.share};
  const auto& lanes = prepare_frame_lanes(workers.isa());
  for_blocks(pass.width, pass.height, workers,
             [&](int x0, int x1, int y0, int y1) { lanes.structure(pass, x0, x1, y0, y1); });
}

void RobustSpread::tbb(const Args& args, Workers& workers) {
  const auto& lanes = prepare_frame_lanes(workers.isa());
  std::vector<float> own;
  std::vector<float>& workspace = args.workspace == nullptr ? own : *args.workspace;
  std::int32_t keys[kSamples];
  const int n = prepare_frame::gather_residuals(args, workspace);
  *args.spread = {};
  if (n == 0) return;
  const float median = median_of(workspace.data(), keys, n, lanes);
  for (int i = 0; i < n; ++i) {
    workspace[static_cast<std::size_t>(i)] =
        std::abs(workspace[static_cast<std::size_t>(i)] - median);
  }
  args.spread->median = static_cast<double>(median);
  args.spread->sigma = 1.4826 * static_cast<double>(median_of(workspace.data(), keys, n, lanes));
}

void Whiten::tbb(const Args& args, Workers& workers) {
  const WhitenPass pass = whiten_pass(args);
  const auto& lanes = prepare_frame_lanes(workers.isa());
  for_blocks(pass.width, pass.height, workers,
             [&](int x0, int x1, int y0, int y1) { lanes.whiten(pass, x0, x1, y0, y1); });
}

}  // namespace glint
