// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/cell_weights/cells.hpp"

#include <algorithm>
#include <stdexcept>

#include "glint/kernels/core/cells.hpp"

namespace glint {
namespace cell_weights {
namespace {

void require(bool holds, const char* sentence) {
  if (!holds) throw std::invalid_argument(sentence);
}

/// Adds to the sums of [begin, end) the part of their windows that lies `rows` rows below.
/// Cells ascend, so the window's first run does too.
void add_row(const CellRuns& runs, std::int64_t width, std::int64_t half_width, std::int64_t rows,
             const float* values, double* sums, std::size_t begin, std::size_t end) {
  const std::uint32_t* cell = runs.cell.data();
  const std::size_t size = runs.size();
  const std::int64_t start = cell[begin] + rows * width - half_width;
  std::size_t first = static_cast<std::size_t>(
      std::lower_bound(cell, cell + size, start,
                       [](std::uint32_t a, std::int64_t b) { return a < b; }) -
      cell);
  for (std::size_t r = begin; r < end; ++r) {
    const std::int64_t x = cell[r] % width, centre = cell[r] + rows * width;
    const std::int64_t low = centre - std::min(half_width, x);
    const std::int64_t high = centre + std::min(half_width, width - 1 - x);
    while (first < size && cell[first] < low) ++first;
    for (std::size_t k = first; k < size && cell[k] <= high; ++k) sums[r - begin] += values[k];
  }
}

}  // namespace

void check(const CellWeights::Args& args) {
  const std::size_t n = args.x.size();
  require(args.y.size() == n && args.predicted.size() == n && args.log_ratio.size() == n &&
              args.updated.size() == n && (args.weighted.empty() || args.weighted.size() == n),
          "particle arrays must have one length");
  require(args.width >= 0 && args.height >= 0 && args.width <= kMaxSide && args.height <= kMaxSide,
          "the frame must have at most 65535 pixels a side");
  require(args.half_width >= 0 && args.clutter >= 0,
          "the window and the clutter must not be negative");
}

void box_sums(const CellRuns& runs, int width, int half_width, const float* values, float* sums,
              std::size_t begin, std::size_t end) {
  constexpr std::size_t kPart = 256;
  for (std::size_t part = begin; part < end; part += kPart) {
    const std::size_t part_end = std::min(end, part + kPart);
    double total[kPart] = {};
    for (int row = -half_width; row <= half_width; ++row) {
      add_row(runs, width, half_width, row, values, total, part, part_end);
    }
    for (std::size_t r = part; r < part_end; ++r) sums[r] = static_cast<float>(total[r - part]);
  }
}

}  // namespace cell_weights

double total_mass(const CellRuns& runs) {
  double sum = 0;
  for (const float mass : runs.mass) sum += mass;
  return sum;
}

void box_sums(const CellRuns& runs, int width, int height, int half_width,
              std::span<const float> values, std::span<float> sums) {
  if (height <= 0 || values.size() != runs.size() || sums.size() != runs.size()) return;
  cell_weights::box_sums(runs, width, half_width, values.data(), sums.data(), 0, runs.size());
}

}  // namespace glint
