// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "glint/kernels/cell_integrals/lanes.hpp"

namespace glint::cell_integrals {

/// Targets sorted by the square of the frame that holds the first corner of their window, so that
/// those at hand together lie together. Squares are no smaller than any window, so that windows
/// that meet lie in adjacent ones, and no more in number than targets, a few times over.
class Grid {
 public:
  /// `sorted` gets the targets by square, in their own order inside one.
  void sort(const std::vector<LaneTarget>& targets, int width, int height,
            std::vector<LaneTarget>& sorted);

  /// Calls f(j) for every other sorted target whose window meets that of `k`, in ascending order.
  template <class F>
  void each_neighbour(const std::vector<LaneTarget>& sorted, std::size_t k, const F& f) const {
    const Box& box = sorted[k].box;
    if (box.x0 >= box.x1) return;
    const int left = std::max(0, box.x0 - reach_) >> shift_, right = (box.x1 - 1) >> shift_;
    const int bottom = (box.y1 - 1) >> shift_;
    for (int row = std::max(0, box.y0 - reach_) >> shift_; row <= bottom; ++row) {
      const std::uint32_t end = start_[square(right, row) + 1];
      for (std::uint32_t j = start_[square(left, row)]; j < end; ++j) {
        const Box& other = sorted[j].box;
        const bool meet = other.x0 < box.x1 && box.x0 < other.x1 && other.y0 < box.y1 &&
                          box.y0 < other.y1 && j != k;
        if (meet) f(j);
      }
    }
  }

  /// Sorted targets [first, end) that hold every neighbour of the sorted targets [begin, end).
  struct Range {
    std::size_t first, end;
  };
  Range around(const std::vector<LaneTarget>& sorted, std::size_t begin, std::size_t end) const {
    const int top = (sorted[begin].box.y0 >> shift_) - 1;
    const int bottom = (sorted[end - 1].box.y0 >> shift_) + 1;
    return {start_[row_start(std::max(0, top))], start_[row_start(std::min(rows_, bottom + 1))]};
  }

 private:
  std::size_t row_start(int row) const { return square(0, row); }
  std::size_t square(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  std::size_t square(const Box& box) const { return square(box.x0 >> shift_, box.y0 >> shift_); }

  int shift_ = 5, reach_ = 0, columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> start_;  ///< first sorted target of each square
};

}  // namespace glint::cell_integrals
