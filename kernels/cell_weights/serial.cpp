// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "glint/kernels/cell_weights/bound.hpp"
#include "glint/kernels/cell_weights/cells.hpp"
#include "glint/kernels/core/cells.hpp"

namespace glint {
namespace {

using Args = CellWeights::Args;

/// Pixel of a particle, or `kOutside`; in float, as the likelihood chooses it.
constexpr std::uint32_t kOutside = ~std::uint32_t{0};
std::uint32_t pixel_of(const Args& args, std::size_t i) {
  const float x = std::floor(args.x[i] + 0.5f), y = std::floor(args.y[i] + 0.5f);
  const auto width = static_cast<float>(args.width), height = static_cast<float>(args.height);
  if (!(x >= 0 && x < width && y >= 0 && y < height)) return kOutside;
  return cell_at(static_cast<int>(x), static_cast<int>(y), args.width);
}

void sort_by_pixel(const Args& args, CellWorkspace& space) {
  const std::size_t n = args.x.size();
  space.keys.resize(n);
  CellRuns& runs = space.runs;
  runs.order.clear();
  for (std::uint32_t i = 0; i < n; ++i) {
    space.keys[i] = pixel_of(args, i);
    if (space.keys[i] != kOutside) runs.order.push_back(i);
  }
  std::sort(runs.order.begin(), runs.order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return space.keys[a] != space.keys[b] ? space.keys[a] < space.keys[b] : a < b;
  });
}

void find_runs(CellWorkspace& space) {
  CellRuns& runs = space.runs;
  runs.cell.clear();
  runs.first.clear();
  for (std::uint32_t k = 0; k < runs.order.size(); ++k) {
    const std::uint32_t pixel = space.keys[runs.order[k]];
    if (!runs.cell.empty() && runs.cell.back() == pixel) continue;
    runs.cell.push_back(pixel);
    runs.first.push_back(k);
  }
  runs.first.push_back(static_cast<std::uint32_t>(runs.order.size()));
}

// bounded_log_ratio() in double.
double bounded(double log_ratio) {
  const double kExact = kExactLogRatio;
  if (log_ratio <= kExact) return log_ratio;
  return std::min<double>(kExact + kExact * std::log(log_ratio / kExact), kMaxLogRatio);
}

double weighted(const Args& args, std::size_t i) {
  const double log_ratio = args.log_ratio[i];
  if (std::isnan(log_ratio)) return 0;
  return args.predicted[i] * std::exp(bounded(log_ratio));
}

// M = sum of w l over a cell; B = sum of M over the window that the likelihood uses.
void sum_cells(const Args& args, CellWorkspace& space) {
  const CellRuns& runs = space.runs;
  space.cell_sum.resize(runs.size());
  space.box_sum.resize(runs.size());
  for (std::size_t r = 0; r < runs.size(); ++r) {
    double sum = 0;
    for (std::uint32_t k = runs.first[r]; k < runs.first[r + 1]; ++k) {
      sum += weighted(args, runs.order[k]);
    }
    space.cell_sum[r] = static_cast<float>(sum);
  }
  const int half_width = args.psi == Psi::window ? args.half_width : 0;
  box_sums(runs, args.width, args.height, half_width, space.cell_sum, space.box_sum);
}

// w' = w l / (lambda + Psi). P-PHD (14)-(16).
void update(const Args& args, CellWorkspace& space) {
  CellRuns& runs = space.runs;
  runs.mass.resize(runs.size());
  std::fill(args.updated.begin(), args.updated.end(), 0.0f);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const double normaliser = double{args.clutter} + space.box_sum[r];
    const double inverse = normaliser > 0 ? 1 / normaliser : 0;
    for (std::uint32_t k = runs.first[r]; k < runs.first[r + 1]; ++k) {
      const std::uint32_t i = runs.order[k];
      args.updated[i] = static_cast<float>(weighted(args, i) * inverse);
    }
    runs.mass[r] = static_cast<float>(space.cell_sum[r] * inverse);
  }
}

}  // namespace

void CellWeights::serial(const Args& args) {
  cell_weights::check(args);
  CellWorkspace own;
  CellWorkspace& space = args.workspace ? *args.workspace : own;
  sort_by_pixel(args, space);
  find_runs(space);
  sum_cells(args, space);
  update(args, space);
  for (std::size_t i = 0; i < args.weighted.size(); ++i) {
    args.weighted[i] = static_cast<float>(weighted(args, i));
  }
}

}  // namespace glint
