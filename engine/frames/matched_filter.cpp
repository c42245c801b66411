// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/matched_filter.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"

namespace glint {
namespace {

/// For each pixel of an axis, the sum of the squared weights that lie inside.
std::vector<float> energies(const PointSpread& spread, int length) {
  std::vector<float> energy;
  const auto weights = spread.centred_weights();
  for (int x = 0; x < length; ++x) {
    double sum = 0;
    int pixel = x - spread.half_width;
    for (const double w : weights) {
      if (pixel >= 0 && pixel < length) sum += w * w;
      ++pixel;
    }
    energy.push_back(static_cast<float>(sum));
  }
  return energy;
}

/// From A - B / 2, P-PHD (13), to A over the root of B, where B is `energy`.
void normalise(float* begin, const float* end, float energy) {
  const float half = energy / 2, root = std::sqrt(energy);
  for (float* value = begin; value != end; ++value) *value = (*value + half) / root;
}

/// A row of which every pixel has its own energy, but those that no side clips have one.
void normalise_row(std::span<float> row, float energy_y, std::span<const float> energy_x,
                   std::size_t margin) {
  const auto one = [&](std::size_t x) { normalise(&row[x], &row[x] + 1, energy_y * energy_x[x]); };
  const std::size_t left = std::min(margin, row.size());
  const std::size_t right = std::max(left, row.size() - left);
  for (std::size_t x = 0; x < left; ++x) one(x);
  if (right > left) {
    normalise(row.data() + left, row.data() + right, energy_y * energy_x[left]);
  }
  for (std::size_t x = right; x < row.size(); ++x) one(x);
}

}  // namespace

MatchedFilter::MatchedFilter(double psf_sigma, const Device& device)
    : device_(device), spread_(PointSpread::of(psf_sigma)) {}

FrameView MatchedFilter::response(FrameView whitened) {
  if (response_.width() != whitened.width || response_.height() != whitened.height) {
    response_ = Image<float>(whitened.width, whitened.height);
    energy_x_ = energies(spread_, whitened.width);
    energy_y_ = energies(spread_, whitened.height);
  }
  const ImageView<float> map = response_.view();
  PixelLikelihood::Args args;
  args.frame = whitened;
  args.spread = spread_;
  args.intensity = 1;
  args.map = map;
  device_.run<PixelLikelihood>(args);
  const Tiles tiles{static_cast<std::size_t>(map.height), kRowTile};
  device_.workers().for_tiles(tiles.tiles(), [&](std::size_t t) {
    for (std::size_t y = tiles.begin(t); y < tiles.end(t); ++y) {
      normalise_row({map.row(static_cast<int>(y)), energy_x_.size()}, energy_y_[y], energy_x_,
                    static_cast<std::size_t>(spread_.half_width));
    }
  });
  return map;
}

}  // namespace glint
