// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/wavelet_filter.hpp"

#include <algorithm>
#include <limits>

#include "glint/engine/frames/intensity_levels.hpp"
#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/prepare_frame/whiten.hpp"

namespace glint {
namespace {

/// [px] from the middle of the widest smoothing to its last tap
constexpr int kReach = 2 << (WaveletFilter::kScales - 1);

Tiles rows_of(FrameView frame) { return {static_cast<std::size_t>(frame.height), kRowTile}; }

/// The index inside [0, n) that mirrors at the first and the last one lead to.
int mirrored(int i, int n) {
  if (n == 1) return 0;
  const int period = 2 * (n - 1);
  const int inside = ((i % period) + period) % period;
  return inside < n ? inside : period - inside;
}

float b3_spline(float a, float b, float c, float d, float e) {
  return (a + e + 4 * (b + d) + 6 * c) * 0.0625F;
}

/// The column-wise smoothing of row y.
void smooth_columns(FrameView from, int y, int hole, float* line) {
  const auto row = [&](int tap) { return from.row(mirrored(y + tap * hole, from.height)); };
  const float *a = row(-2), *b = row(-1), *c = row(0), *d = row(1), *e = row(2);
  for (int x = 0; x < from.width; ++x) line[x] = b3_spline(a[x], b[x], c[x], d[x], e[x]);
}

void mirror_ends(float* line, int width, int reach) {
  for (int x = 1; x <= reach; ++x) {
    line[-x] = line[mirrored(-x, width)];
    line[width - 1 + x] = line[mirrored(width - 1 + x, width)];
  }
}

void smooth_row(const float* line, int width, int hole, float* out) {
  for (int x = 0; x < width; ++x) {
    const float* at = line + x;
    out[x] = b3_spline(at[-2 * hole], at[-hole], at[0], at[hole], at[2 * hole]);
  }
}

/// Adds a scale's coefficients, in their sigmas, where they exceed k.
void add_significant(const float* finer, const float* coarser, float sigma, float k, int width,
                     float* sum) {
  for (int x = 0; x < width; ++x) {
    const float u = (finer[x] - coarser[x]) / sigma;
    sum[x] += u > k ? u : 0.0F;
  }
}

void finish_row(const float* whitened, int width, float* sum) {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  constexpr auto kScale = static_cast<float>(1 / WaveletFilter::kUnitSum);
  for (int x = 0; x < width; ++x) sum[x] = whitened[x] != 0 ? sum[x] * kScale : kUnknown;
}

}  // namespace

void WaveletFilter::fit(FrameView frame) {
  if (response_.width() == frame.width && response_.height() == frame.height) return;
  for (Image<float>& image : smooth_) image = Image<float>(frame.width, frame.height);
  response_ = Image<float>(frame.width, frame.height);
  lines_.assign(rows_of(frame).tiles(),
                std::vector<float>(static_cast<std::size_t>(frame.width) + 2 * kReach));
  for (std::vector<float>& samples : samples_) samples.reserve(RobustSpread::kSamples);
}

/// c_`scale`.
FrameView WaveletFilter::level(FrameView whitened, std::size_t scale) const {
  return scale == 0 ? whitened : smooth_[scale - 1].view();
}

/// Makes c_{scale + 1} of `from`, which is c_`scale`.
void WaveletFilter::smooth(FrameView from, std::size_t scale) {
  const ImageView<float> to = smooth_[scale].view();
  const int hole = 1 << scale;
  const Tiles tiles = rows_of(from);
  device_.workers().for_tiles(tiles.tiles(), [&](std::size_t t) {
    float* line = lines_[t].data() + kReach;
    for (auto y = static_cast<int>(tiles.begin(t)); y < static_cast<int>(tiles.end(t)); ++y) {
      smooth_columns(from, y, hole, line);
      mirror_ends(line, from.width, 2 * hole);
      smooth_row(line, from.width, hole, to.row(y));
    }
  });
}

void WaveletFilter::measure_noise(FrameView whitened) {
  const int step = RobustSpread::step(whitened.width, whitened.height);
  device_.workers().for_tiles(kScales, [&](std::size_t j) {
    const FrameView finer = level(whitened, j), coarser = level(whitened, j + 1);
    std::vector<float>& samples = samples_[j];
    samples.clear();
    for (int y = 0; y < whitened.height; y += step) {
      for (int x = 0; x < whitened.width; x += step) {
        if (whitened(x, y) != 0) samples.push_back(finer(x, y) - coarser(x, y));
      }
    }
    sigma_[j] = static_cast<float>(std::max(kUnitNoise[j], robust_moments(samples).sigma));
  });
}

void WaveletFilter::add_up(FrameView whitened, float k) {
  const ImageView<float> sum = response_.view();
  const Tiles tiles = rows_of(whitened);
  device_.workers().for_tiles(tiles.tiles(), [&](std::size_t t) {
    for (auto y = static_cast<int>(tiles.begin(t)); y < static_cast<int>(tiles.end(t)); ++y) {
      float* row = sum.row(y);
      std::fill_n(row, sum.width, 0.0F);
      for (std::size_t j = 0; j < kScales; ++j) {
        add_significant(level(whitened, j).row(y), level(whitened, j + 1).row(y), sigma_[j], k,
                        sum.width, row);
      }
      finish_row(whitened.row(y), sum.width, row);
    }
  });
}

FrameView WaveletFilter::response(FrameView whitened, double k) {
  fit(whitened);
  for (std::size_t j = 0; j < kScales; ++j) smooth(level(whitened, j), j);
  measure_noise(whitened);
  add_up(whitened, static_cast<float>(k));
  return response_.view();
}

}  // namespace glint
