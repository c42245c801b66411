// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/point_finder.hpp"

#include <algorithm>
#include <numeric>

namespace glint {

void describe(FieldList& list, PointsConfig& c) {
  list("detector", c.detector,
       {{"matched-filter", PointDetector::matched_filter},
        {"wavelet", PointDetector::wavelet},
        {"unit-5x5", PointDetector::unit_5x5}},
       "maxima of the matched filter, or of wavelets of three scales, or blocks of 5x5 pixels that "
       "are bright on the mean");
  list("psf_sigma", c.psf_sigma, 0.1, 2.6, "px", "point spread of the matched filter");
  list("wavelet_k", c.wavelet_k, 0, 1000, "sigma",
       "wavelets: what a scale sees counts if it exceeds so many of the scale's own sigmas");
  list("threshold", c.threshold, -100, 1000, "sigma",
       "least value of the matched filter, or of the wavelets' sum");
  list("radius", c.radius, 1, 100, "px", "a point is the maximum of this neighbourhood");
  list("unit_threshold", c.unit_threshold, 0, 1e6, "mean intensity of the frame",
       "a block's mean must exceed this");
}

PointFinder::PointFinder(const PointsConfig& config, const Device& device)
    : config_(valid(config)),
      device_(device),
      matched_(config.psf_sigma, device),
      wavelet_(device) {}

void PointFinder::find(const Scan& scan, std::vector<PointMeasurement>& points) {
  if (config_.detector == PointDetector::unit_5x5) {
    find_units(scan);
  } else {
    find_maxima(scan);
  }
  points.clear();
  for (const Point& p : found_) points.push_back({p.x, p.y, p.amplitude});
}

/// Into found_.
void PointFinder::find_maxima(const Scan& scan) {
  FindPoints::Args args;
  args.threshold = static_cast<float>(config_.threshold);
  if (config_.detector == PointDetector::wavelet) {
    args.map = wavelet_.response(scan.whitened.view(), config_.wavelet_k);
    args.threshold = std::max(args.threshold, 0.0F);  // 0 is where no scale sees anything
  } else {
    args.map = matched_.response(scan.whitened.for_kernels());
  }
  args.radius = config_.radius;
  args.points = &found_;
  args.workspace = &workspace_;
  device_.run<FindPoints>(args);
}

/// Into found_.
void PointFinder::find_units(const Scan& scan) {
  FindPoints::Args args;
  args.map = scan.raw.view();
  args.mode = FindPoints::Mode::unit_5x5;
  args.threshold = static_cast<float>(config_.unit_threshold * mean(args.map));
  args.points = &found_;
  args.workspace = &workspace_;
  device_.run<FindPoints>(args);
}

/// Row sums, then their sum in row order: the same for any number of threads.
double PointFinder::mean(FrameView frame) {
  if (frame.empty()) return 0;
  row_sums_.resize(static_cast<std::size_t>(frame.height));
  device_.workers().for_tiles(row_sums_.size(), [&](std::size_t y) {
    const float* row = frame.row(static_cast<int>(y));
    row_sums_[y] = std::accumulate(row, row + frame.width, 0.0);
  });
  return std::accumulate(row_sums_.begin(), row_sums_.end(), 0.0) /
         (static_cast<double>(frame.width) * frame.height);
}

}  // namespace glint
