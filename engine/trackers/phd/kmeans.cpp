// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/kmeans.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace glint {
namespace {

struct Centre {
  double x, y, mass;
};

std::size_t nearest(const std::vector<Centre>& centres, double x, double y) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < centres.size(); ++c) {
    const double dx = x - centres[c].x, dy = y - centres[c].y;
    if (dx * dx + dy * dy < least) least = dx * dx + dy * dy, best = c;
  }
  return best;
}

/// Particles drawn in proportion to their weights.
std::vector<Centre> seeds(const Particles& p, double total, std::size_t count, RandomKey key) {
  std::vector<Centre> centres;
  for (std::uint32_t c = 0; c < count; ++c) {
    double left = uniform(random_words(key, c).w[0]) * total;
    std::size_t i = 0;
    while (i + 1 < p.size() && left >= p.weight[i]) left -= p.weight[i++];
    centres.push_back({p.x[i], p.y[i], 0});
  }
  return centres;
}

}  // namespace

std::vector<Peak> kmeans_states(const Particles& p, RandomKey key,
                                std::vector<std::uint32_t>& members) {
  constexpr int kIterations = 20;
  members.clear();
  const double total = std::accumulate(p.weight.begin(), p.weight.end(), 0.0);
  const auto count = static_cast<std::size_t>(std::max(0.0, std::round(total)));  // P-PHD (19)
  if (count == 0) return {};
  auto centres = seeds(p, total, count, key);
  std::vector<std::size_t> of(p.size());
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    std::vector<Centre> sums(count, Centre{0, 0, 0});
    for (std::size_t i = 0; i < p.size(); ++i) {
      of[i] = nearest(centres, p.x[i], p.y[i]);
      auto& s = sums[of[i]];
      s.x += p.weight[i] * p.x[i], s.y += p.weight[i] * p.y[i], s.mass += p.weight[i];
    }
    for (std::size_t c = 0; c < count; ++c) {
      if (sums[c].mass > 0) centres[c] = {sums[c].x / sums[c].mass, sums[c].y / sums[c].mass, 0};
    }
  }
  std::vector<Peak> peaks;
  for (std::size_t c = 0; c < count; ++c) {
    const std::size_t first = members.size();
    for (std::uint32_t i = 0; i < p.size(); ++i) {
      if (of[i] == c && p.weight[i] > 0) members.push_back(i);
    }
    if (members.size() == first) continue;
    peaks.push_back(describe_cluster(p, std::span(members).subspan(first), p.weight));
    peaks.back().first = first, peaks.back().last = members.size();
  }
  return peaks;
}

}  // namespace glint
