// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>

#include "glint/engine/metrics/by_frame.hpp"
#include "glint/engine/metrics/evaluation.hpp"

namespace glint {
namespace {

struct Counts {
  std::int64_t matched = 0, false_points = 0;
};

/// A detector's output by frame, strongest first, so that a threshold keeps a prefix.
struct Detector {
  std::vector<std::vector<TruthPoint>> truth;
  std::vector<std::vector<Detection>> detections;
  const EvaluationOptions& options;

  Counts count(double threshold) const {
    Counts total;
    for (std::size_t k = 0; k < truth.size(); ++k) {
      const std::vector<Detection>& all = detections[k];
      const auto end = std::find_if(all.begin(), all.end(), [threshold](const Detection& d) {
        return !(d.amplitude >= threshold);
      });
      const std::vector<Detection> kept(all.begin(), end);
      const auto matched = static_cast<std::int64_t>(
          match(positions(truth[k]), positions(kept), options.cutoff, options.order).size());
      total.matched += matched;
      total.false_points += static_cast<std::int64_t>(kept.size()) - matched;
    }
    return total;
  }
};

std::vector<std::vector<Detection>> strongest_first(std::span<const Detection> detections,
                                                    std::int64_t frames) {
  auto sorted = by_frame(detections, frames);
  for (std::vector<Detection>& of : sorted) {
    std::erase_if(of, [](const Detection& d) { return std::isnan(d.amplitude); });
    std::stable_sort(of.begin(), of.end(), [](const Detection& a, const Detection& b) {
      return a.amplitude > b.amplitude;
    });
  }
  return sorted;
}

/// All amplitudes that occur, falling: the finest grid there is.
std::vector<double> thresholds(std::span<const Detection> detections) {
  std::vector<double> all;
  for (const Detection& d : detections) all.push_back(d.amplitude);
  std::erase_if(all, [](double a) { return std::isnan(a); });
  std::sort(all.begin(), all.end(), std::greater<>());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

Baseline detector_baseline(std::span<const TruthPoint> truth, std::span<const Detection> detections,
                           double false_points_per_frame, const EvaluationOptions& options) {
  const std::int64_t frames =
      options.frames.value_or(std::max(frame_count(truth), frame_count(detections)));
  const Detector detector{by_frame(truth, frames), strongest_first(detections, frames), options};
  const double allowed = false_points_per_frame * static_cast<double>(frames) * (1 + 1e-12);
  const std::vector<double> grid = thresholds(detections);
  Baseline best;
  Counts counts;
  std::size_t low = 0, high = grid.size();  // the first `low` thresholds are allowed
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    const Counts now = detector.count(grid[middle]);
    if (static_cast<double>(now.false_points) > allowed) {
      high = middle;
      continue;
    }
    low = middle + 1;
    counts = now;
    best.threshold = grid[middle];
  }
  std::size_t truth_points = 0;
  for (const std::vector<TruthPoint>& of : detector.truth) truth_points += of.size();
  if (truth_points > 0) {
    best.detected_points = static_cast<double>(counts.matched) / static_cast<double>(truth_points);
  }
  if (frames > 0) {
    best.false_points_per_frame =
        static_cast<double>(counts.false_points) / static_cast<double>(frames);
  }
  return best;
}

}  // namespace glint
