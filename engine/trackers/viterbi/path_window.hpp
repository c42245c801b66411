// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/resident_memory.hpp"
#include "glint/kernels/find_points/find_points.hpp"

namespace glint {

inline constexpr int kMaxPathStages = 32;

/// A path through the window: a cell a stage.
struct WindowPath {
  struct Cell {
    int x, y;
    float score;
    /// Sum of the likelihood ratios around the cell, its own included, over its own.
    double weight = 1;
    double var_x = 0, cov_xy = 0, var_y = 0;  ///< by these ratios, about the cell's centre [px^2]
  };
  std::size_t first = 0, last = 0;  ///< stages [first, last) that it holds after trimming
  double total = 0;                 ///< of all stages
  /// Logarithm of the odds of a target on this path, or one near it, against none, if one is
  /// expected in the frame and all moves are alike.
  double log_odds = 0;
  std::array<Cell, kMaxPathStages> cells{};
};

/// What moves a stage allows, both in pixels along each axis.
struct StageMoves {
  int reach = 3;
  int tolerance = 2;  ///< of a move against the move before it

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.reach, s.tolerance);
  }
};

/// The last few score maps, and the best paths through them by dynamic programming.
class PathWindow {
 public:
  /// `stages` is 2 to kMaxPathStages; `separation` [px].
  PathWindow(int stages, double separation, const Device& device);

  /// The map that the next stage's scores go to, of this size; a new size starts the window anew.
  ImageView<float> next(int width, int height);
  /// The map that next() gave is filled: it is the newest stage, reached by these moves.
  void push(StageMoves moves);
  bool full() const { return count_ == stages_.size(); }
  std::size_t filled() const { return count_; }          ///< stages so far
  std::size_t stages() const { return stages_.size(); }  ///< of a full window

  /// Paths of a full window that end in local maxima above the threshold, by falling total. Of two
  /// that come within `separation` of each other at any stage the better is kept. Stages at either
  /// end whose scores add up to nothing positive are trimmed.
  std::span<const WindowPath> find(float threshold);

  // What find() makes of the scores is made anew every time.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.stages_, s.oldest_, s.count_);
  }
  void restored();

 private:
  struct Stage {
    ResidentImage<float> score;
    ResidentImage<std::int8_t> dx, dy;
    StageMoves moves;
    std::vector<bool> fetched;  ///< by row: on the host since the last run

    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.score, s.moves);
    }
  };
  Stage& stage(std::size_t k) { return stages_[(oldest_ + k) % stages_.size()]; }
  void make_maps(int width, int height);
  int width() const { return total_[0].width(); }
  int height() const { return total_[0].height(); }
  void run();
  void fetch_row(Stage& stage, int y) const;
  WindowPath trace(int x, int y);
  bool crowded(const WindowPath& path) const;
  void look_around(WindowPath& path);

  double separation_;
  Device device_;
  std::vector<Stage> stages_;  // a ring
  std::size_t oldest_ = 0, count_ = 0;
  ResidentImage<float> total_[2];
  std::size_t newest_total_ = 0;
  std::vector<Point> terminals_;
  PointWorkspace workspace_;
  std::vector<WindowPath> paths_;
};

}  // namespace glint
