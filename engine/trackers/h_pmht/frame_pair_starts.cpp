// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/h_pmht/frame_pair_starts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "glint/engine/state/bytes.hpp"
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"

namespace glint {

void pair_points(std::span<const Point> before, std::span<const Point> now, double reach,
                 std::vector<FramePairStart>& pairs) {
  pairs.clear();
  // Pixels come row by row, sub-pixel maxima up to half a pixel off.
  const double above = reach + 2, below = reach + 1;
  std::size_t first = 0;
  for (const Point& b : now) {
    while (first < before.size() && before[first].y < b.y - above) ++first;
    for (std::size_t i = first; i < before.size() && before[i].y <= b.y + below; ++i) {
      const Point& a = before[i];
      const double dx = b.x - a.x, dy = b.y - a.y;
      if (dx * dx + dy * dy > reach * reach) continue;
      pairs.push_back({b.x, b.y, a.x, a.y, static_cast<double>(a.amplitude) + b.amplitude});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const FramePairStart& a, const FramePairStart& b) {
    return std::tie(b.score, a.y, a.x, a.before_y, a.before_x) <
           std::tie(a.score, b.y, b.x, b.before_y, b.before_x);
  });
}

void FramePairStarts::restored() const {
  for (const Point& p : now_) {
    require_bytes(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.amplitude),
                  "a point is nowhere");
  }
}

std::span<const FramePairStart> FramePairStarts::find(FrameView whitened, double reach) {
  std::swap(before_, now_);
  find_points(whitened);
  pair_points(before_, now_, reach, pairs_);
  return pairs_;
}

void FramePairStarts::find_points(FrameView whitened) {
  if (whitened.empty()) return now_.clear();
  if (ratio_.width() != whitened.width || ratio_.height() != whitened.height) {
    ratio_ = ResidentImage<float>(whitened.width, whitened.height, device_);
  }
  PixelLikelihood::Args likelihood;
  likelihood.frame = whitened;
  likelihood.spread = spread_;
  likelihood.intensity = static_cast<float>(intensity_);
  likelihood.map = ratio_.view();
  device_.run<PixelLikelihood>(likelihood);
  FindPoints::Args maxima;
  maxima.map = ratio_.view();
  maxima.threshold = static_cast<float>(threshold_);
  maxima.points = &now_;
  maxima.workspace = &workspace_;
  device_.run<FindPoints>(maxima);
}

}  // namespace glint
