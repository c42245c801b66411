// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/matched_filter.hpp"

#include <cmath>

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
  for (int y = 0; y < map.height; ++y) {
    float* row = map.row(y);
    const float ey = energy_y_[static_cast<std::size_t>(y)];
    for (int x = 0; x < map.width; ++x) {
      const float energy = ey * energy_x_[static_cast<std::size_t>(x)];
      row[x] = (row[x] + energy / 2) / std::sqrt(energy);  // the map is A - B / 2, P-PHD (13)
    }
  }
  return map;
}

void MatchedFilter::points(FrameView whitened, double threshold, int radius,
                           std::vector<Point>& points) {
  FindPoints::Args args;
  args.map = response(whitened);
  args.threshold = static_cast<float>(threshold);
  args.radius = radius;
  args.points = &points;
  args.workspace = &workspace_;
  device_.run<FindPoints>(args);
}

}  // namespace glint
