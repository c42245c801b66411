// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "glint/engine/trackers/jpda/jpda_cluster.hpp"

namespace glint {

/// Sums over all joint events of a cluster by dynamic programming: over its targets with the set of
/// points used so far, or, if there are fewer targets, over its points with the set of targets
/// served. The cost is that of the table times the points of a target.
class JpdaExact {
 public:
  /// Numbers in the table; the largest std::size_t where that does not hold it.
  static std::size_t table(std::size_t targets, std::size_t points);

  /// Weight of all events with d points assigned, by d, up to a common factor; sums to 1.
  void polynomial(const JpdaCluster& cluster, std::vector<double>& by_number);
  /// Probabilities of no point, by target, and of each link, where an event with d points assigned
  /// has the further weight `factor[d]`; for d up to the smaller of targets and points.
  void marginals(const JpdaCluster& cluster, std::span<const double> factor,
                 std::span<double> missed, std::span<double> linked);

 private:
  /// A row of the table is a target (or point), a column a point (or target) of the set.
  struct Option {
    std::uint32_t bit, link;
    double weight;
  };
  void lay_out(const JpdaCluster& cluster);
  void forward();
  /// Goes through the table from the last row to the first.
  void backward(std::span<double> missed, std::span<double> linked);
  void missed_columns(std::span<double> missed) const;
  std::span<const double> row(std::size_t r) const {
    return std::span(table_).subspan(r * sets_, sets_);
  }

  bool rows_are_targets_ = true;
  std::size_t rows_ = 0, columns_ = 0, sets_ = 1;
  std::vector<std::size_t> begin_;  // of a row's options
  std::vector<Option> options_;
  std::vector<double> stay_;    // weight of a row without an option
  std::vector<double> finish_;  // weight of the columns that a set lacks
  std::vector<double> table_;   // by row and set: weight of what comes before the row
  std::vector<double> back_, next_;
};

}  // namespace glint
