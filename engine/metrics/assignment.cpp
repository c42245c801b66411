// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/metrics/assignment.hpp"

#include <limits>
#include <utility>

namespace glint {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Dual prices and the matching so far, for at most as many rows as columns. Column `columns` is a
/// root that stands for "no column".
struct Auction {
  const Eigen::MatrixXd& costs;
  Eigen::Index rows = costs.rows(), columns = costs.cols();
  std::vector<double> row_price = std::vector<double>(static_cast<std::size_t>(rows), 0.0);
  std::vector<double> column_price = std::vector<double>(static_cast<std::size_t>(columns) + 1);
  std::vector<int> row_of = std::vector<int>(static_cast<std::size_t>(columns) + 1, -1);
};

struct Reach {
  std::vector<double> slack;  // least reduced cost to each column
  std::vector<int> previous;  // column before it on the cheapest path
  std::vector<bool> done;
};

/// Relaxes all columns from `column`; returns the nearest that is not done, and moves the prices so
/// that its slack is 0.
std::size_t advance(Auction& a, Reach& reach, std::size_t column) {
  const auto row = static_cast<std::size_t>(a.row_of[column]);
  double nearest = kInfinity;
  std::size_t next = 0;
  const auto columns = static_cast<std::size_t>(a.columns);
  for (std::size_t c = 0; c < columns; ++c) {
    if (reach.done[c]) continue;
    const double reduced = a.costs(a.row_of[column], static_cast<Eigen::Index>(c)) -
                           a.row_price[row] - a.column_price[c];
    if (reduced < reach.slack[c])
      reach.slack[c] = reduced, reach.previous[c] = static_cast<int>(column);
    if (reach.slack[c] < nearest) nearest = reach.slack[c], next = c;
  }
  for (std::size_t c = 0; c <= columns; ++c) {
    if (reach.done[c]) {
      a.row_price[static_cast<std::size_t>(a.row_of[c])] += nearest;
      a.column_price[c] -= nearest;
    } else if (c < columns) {
      reach.slack[c] -= nearest;
    }
  }
  return next;
}

/// Adds `row` to the matching along the cheapest augmenting path.
void augment(Auction& a, int row) {
  const auto size = static_cast<std::size_t>(a.columns) + 1;
  Reach reach{std::vector<double>(size, kInfinity), std::vector<int>(size, -1),
              std::vector<bool>(size, false)};
  std::size_t column = size - 1;
  a.row_of[column] = row;
  while (a.row_of[column] != -1) {
    reach.done[column] = true;
    column = advance(a, reach, column);
  }
  while (column != size - 1) {
    const auto before = static_cast<std::size_t>(reach.previous[column]);
    a.row_of[column] = a.row_of[before];
    column = before;
  }
}

std::vector<int> assign_wide(const Eigen::MatrixXd& costs) {
  Auction auction{costs};
  for (int row = 0; row < costs.rows(); ++row) augment(auction, row);
  std::vector<int> column_of(static_cast<std::size_t>(costs.rows()), -1);
  for (int c = 0; c < costs.cols(); ++c) {
    const int row = auction.row_of[static_cast<std::size_t>(c)];
    if (row >= 0) column_of[static_cast<std::size_t>(row)] = c;
  }
  return column_of;
}

}  // namespace

std::vector<int> assign_least_cost(const Eigen::MatrixXd& costs) {
  if (costs.rows() <= costs.cols()) return assign_wide(costs);
  const std::vector<int> row_of = assign_wide(costs.transpose());
  std::vector<int> column_of(static_cast<std::size_t>(costs.rows()), -1);
  for (std::size_t c = 0; c < row_of.size(); ++c) {
    column_of[static_cast<std::size_t>(row_of[c])] = static_cast<int>(c);
  }
  return column_of;
}

}  // namespace glint
