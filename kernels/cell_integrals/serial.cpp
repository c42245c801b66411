// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "glint/kernels/cell_integrals/window.hpp"

namespace glint {
namespace {

using cell_integrals::PartialSums;
using Args = CellIntegrals::Args;

bool is_dark(const CellRule& rule, float pixel) {
  return !(pixel > rule.threshold && std::isfinite(pixel));
}

bool is_missing(const CellRule& rule, float pixel, int x, int y) {
  if (rule.truncate_dark && is_dark(rule, pixel)) return true;
  return std::any_of(rule.missing.begin(), rule.missing.end(),
                     [&](const Box& box) { return box.contains(x, y); });
}

double intensity(const CellRule& rule, float pixel) {
  if (is_dark(rule, pixel)) return 0;
  return rule.subtract ? static_cast<double>(pixel) - rule.threshold : pixel;
}

/// Integrals of a unit normal's N(0, sigma^2), u N and u^2 N over one cell of an axis.
struct AxisCell {
  double p = 0, first = 0, second = 0;
};

/// The cell [a, b] seen from the mean. Differences of tails are taken on the small side of erfc,
/// and moments are kept inside the cell, which cancellation could leave far out.
AxisCell axis_cell(double a, double b, double sigma) {
  const double scale = 1 / (sigma * std::numbers::sqrt2);
  const double left = a > 0 ? a : -b, right = a > 0 ? b : -a;  // mirrored: erfc is small there
  const double p = 0.5 * (std::erfc(left * scale) - std::erfc(right * scale));
  const auto density = [&](double u) {
    return std::exp(-0.5 * u * u / (sigma * sigma)) / (sigma * std::sqrt(2 * std::numbers::pi));
  };
  const double variance = sigma * sigma, at_a = density(a), at_b = density(b);
  const double first = variance * (at_a - at_b);
  const double second = variance * (p + a * at_a - b * at_b);
  const double near = a * b < 0 ? 0 : std::min(a * a, b * b), far = std::max(a * a, b * b);
  return {p, std::clamp(first, a * p, b * p), std::clamp(second, near * p, far * p)};
}

/// A target's window with the integrals of its columns and rows.
struct TargetCells {
  Box box;
  std::vector<AxisCell> columns, rows;

  double p(int x, int y) const {  // P-HPMHT (6)
    return columns[static_cast<std::size_t>(x - box.x0)].p *
           rows[static_cast<std::size_t>(y - box.y0)].p;
  }
};

TargetCells cells_of_target(const HistogramTarget& t, const Args& args) {
  TargetCells cells{
      cell_integrals::window_of(t, args.reach, args.frame.width, args.frame.height), {}, {}};
  for (int x = cells.box.x0; x < cells.box.x1; ++x) {
    cells.columns.push_back(axis_cell(x - 0.5 - t.x, x + 0.5 - t.x, t.sigma_x));
  }
  for (int y = cells.box.y0; y < cells.box.y1; ++y) {
    cells.rows.push_back(axis_cell(y - 0.5 - t.y, y + 0.5 - t.y, t.sigma_y));
  }
  return cells;
}

template <class F>
void each_cell(const Box& box, const F& f) {
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) f(x, y);
  }
}

/// The mixture (7) over the pixels that windows cover; the rest of `p` is stale.
void add_up(const Args& args, const std::vector<TargetCells>& all, ImageView<double> p) {
  const double background = args.background / cell_integrals::cells_of(args);
  for (const TargetCells& cells : all) {
    each_cell(cells.box, [&](int x, int y) { p(x, y) = background; });
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    each_cell(all[k].box,
              [&](int x, int y) { p(x, y) += args.targets[k].proportion * all[k].p(x, y); });
  }
}

PartialSums sums_of(const Args& args, const TargetCells& cells, ImageView<const double> p) {
  PartialSums s;
  each_cell(cells.box, [&](int x, int y) {
    const AxisCell& cx = cells.columns[static_cast<std::size_t>(x - cells.box.x0)];
    const AxisCell& cy = cells.rows[static_cast<std::size_t>(y - cells.box.y0)];
    s.probability += cx.p * cy.p;
    if (is_missing(args.rule, args.frame(x, y), x, y)) {
      s.missing += cx.p * cy.p;
      s.missing_x += cx.first * cy.p, s.missing_y += cx.p * cy.first;
      s.missing_xx += cx.second * cy.p, s.missing_yy += cx.p * cy.second;
      return;
    }
    const double weight = intensity(args.rule, args.frame(x, y)) / p(x, y);
    s.count += weight * cx.p * cy.p;                                       // P-HPMHT (11)
    s.x += weight * cx.first * cy.p, s.y += weight * cx.p * cy.first;      // (10), (11)
    s.xx += weight * cx.second * cy.p, s.yy += weight * cx.p * cy.second;  // (17), (18)
  });
  return s;
}

/// Sum of z log(P_l / (pi_0 / S)) over the displayed cells of the windows, each cell once. Spoils
/// the mixture.
double log_ratios(const Args& args, const std::vector<TargetCells>& all, ImageView<double> p) {
  const double background = args.background / cell_integrals::cells_of(args);
  double sum = 0;
  for (const TargetCells& cells : all) {
    each_cell(cells.box, [&](int x, int y) {
      if (p(x, y) == 0) return;
      const float pixel = args.frame(x, y);
      if (!is_missing(args.rule, pixel, x, y)) {
        sum += intensity(args.rule, pixel) * std::log(p(x, y) / background);
      }
      p(x, y) = 0;
    });
  }
  return sum;
}

}  // namespace

void SumCells::serial(const Args& args) {
  CellTotal total;
  each_cell({0, 0, args.frame.width, args.frame.height}, [&](int x, int y) {
    const float pixel = args.frame(x, y);
    if (is_missing(args.rule, pixel, x, y)) return;
    total.norm += intensity(args.rule, pixel);
    total.shown += 1;
  });
  *args.total = total;
}

void CellIntegrals::serial(const Args& args) {
  cell_integrals::check(args);
  IntegralsWorkspace own;
  std::vector<double>& mixture = (args.workspace != nullptr ? *args.workspace : own).mixture;
  const int width = args.frame.width, height = args.frame.height;
  mixture.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const ImageView<double> p{mixture.data(), width, height, width};
  std::vector<TargetCells> cells;
  for (const HistogramTarget& t : args.targets) cells.push_back(cells_of_target(t, args));
  add_up(args, cells, p);
  std::vector<PartialSums> partial;
  for (const TargetCells& c : cells) partial.push_back(sums_of(args, c, p));
  const cell_integrals::Totals totals = cell_integrals::totals_of(args, partial);
  for (std::size_t k = 0; k < partial.size(); ++k) {
    args.sums[k] = cell_integrals::normalised(args.targets[k], partial[k], totals.missing_weight);
  }
  cell_integrals::fill_mixture(args, totals, args.log_likelihood ? log_ratios(args, cells, p) : 0);
}

}  // namespace glint
