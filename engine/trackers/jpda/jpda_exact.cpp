// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/jpda_exact.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace glint {
namespace {

/// A common factor does not matter, and keeps what is small from vanishing.
void rescale(std::span<double> values) {
  const double largest = *std::ranges::max_element(values);
  if (!(largest > 0)) return;
  for (double& v : values) v /= largest;
}

}  // namespace

std::size_t JpdaExact::table(std::size_t targets, std::size_t points) {
  const std::size_t rows = std::max(targets, points) + 1, columns = std::min(targets, points);
  if (columns + static_cast<std::size_t>(std::bit_width(rows)) >= 31) {
    return std::numeric_limits<std::size_t>::max();
  }
  return rows << columns;
}

void JpdaExact::lay_out(const JpdaCluster& cluster) {
  const std::size_t targets = cluster.missed.size();
  rows_are_targets_ = cluster.points <= targets;
  rows_ = std::max(targets, cluster.points), columns_ = std::min(targets, cluster.points);
  sets_ = std::size_t{1} << columns_;
  const auto row_of = [&](const JpdaLink& l) { return rows_are_targets_ ? l.target : l.point; };
  begin_.assign(rows_ + 2, 0);
  for (const JpdaLink& link : cluster.links) ++begin_[row_of(link) + 2];
  for (std::size_t r = 2; r < begin_.size(); ++r) begin_[r] += begin_[r - 1];
  options_.resize(cluster.links.size());
  for (std::uint32_t l = 0; l < cluster.links.size(); ++l) {
    const JpdaLink& link = cluster.links[l];
    const std::uint32_t column = rows_are_targets_ ? link.point : link.target;
    options_[begin_[row_of(link) + 1]++] = {std::uint32_t{1} << column, l, link.weight};
  }
  stay_.assign(rows_, 1);
  finish_.assign(sets_, 1);
  if (rows_are_targets_) {
    std::ranges::copy(cluster.missed, stay_.begin());
    return;
  }
  for (std::size_t set = sets_ - 1; set-- > 0;) {
    const int lacks = std::countr_one(set);
    finish_[set] = finish_[set | (std::size_t{1} << lacks)] * cluster.missed[lacks];
  }
}

void JpdaExact::forward() {
  table_.assign((rows_ + 1) * sets_, 0);
  table_[0] = 1;
  for (std::size_t r = 0; r < rows_; ++r) {
    const std::span from = std::span(table_).subspan(r * sets_, sets_);
    const std::span to = std::span(table_).subspan((r + 1) * sets_, sets_);
    for (std::size_t set = 0; set < sets_; ++set) {
      if (from[set] == 0) continue;
      to[set] += from[set] * stay_[r];
      for (std::size_t o = begin_[r]; o < begin_[r + 1]; ++o) {
        if ((set & options_[o].bit) == 0)
          to[set | options_[o].bit] += from[set] * options_[o].weight;
      }
    }
    rescale(to);
  }
}

void JpdaExact::polynomial(const JpdaCluster& cluster, std::vector<double>& by_number) {
  lay_out(cluster);
  forward();
  by_number.assign(columns_ + 1, 0);
  double sum = 0;
  for (std::size_t set = 0; set < sets_; ++set) {
    const double weight = row(rows_)[set] * finish_[set];
    by_number[static_cast<std::size_t>(std::popcount(set))] += weight;
    sum += weight;
  }
  if (!(sum > 0)) return;
  for (double& p : by_number) p /= sum;
}

void JpdaExact::marginals(const JpdaCluster& cluster, std::span<const double> factor,
                          std::span<double> missed, std::span<double> linked) {
  lay_out(cluster);
  forward();
  back_.resize(sets_), next_.assign(sets_, 0);
  for (std::size_t set = 0; set < sets_; ++set) {
    back_[set] = finish_[set] * factor[static_cast<std::size_t>(std::popcount(set))];
  }
  rescale(back_);
  std::ranges::fill(missed, 1), std::ranges::fill(linked, 0);
  if (!rows_are_targets_) missed_columns(missed);
  backward(missed, linked);
}

void JpdaExact::backward(std::span<double> missed, std::span<double> linked) {
  for (std::size_t r = rows_; r-- > 0;) {
    const std::span<const double> before = row(r);
    const std::size_t first = begin_[r], last = begin_[r + 1];
    double stayed = 0, all = 0;
    for (std::size_t set = 0; set < sets_; ++set) {
      if (before[set] == 0) continue;
      next_[set] = stay_[r] * back_[set];
      stayed += before[set] * next_[set];
      for (std::size_t o = first; o < last; ++o) {
        if ((set & options_[o].bit) != 0) continue;
        const double ahead = options_[o].weight * back_[set | options_[o].bit];
        linked[options_[o].link] += before[set] * ahead;
        next_[set] += ahead;
      }
      all += before[set] * next_[set];
    }
    if (all > 0) {
      for (std::size_t o = first; o < last; ++o) linked[options_[o].link] /= all;
      if (rows_are_targets_) missed[r] = stayed / all;
    }
    rescale(next_);
    std::swap(back_, next_);
  }
}

void JpdaExact::missed_columns(std::span<double> missed) const {
  std::ranges::fill(missed, 0);
  double all = 0;
  for (std::size_t set = 0; set < sets_; ++set) {
    const double weight = row(rows_)[set] * back_[set];
    all += weight;
    for (std::size_t c = 0; c < columns_; ++c) {
      if ((set >> c & 1) == 0) missed[c] += weight;
    }
  }
  for (double& p : missed) p = all > 0 ? p / all : 1;
}

}  // namespace glint
