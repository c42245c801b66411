// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "glint/kernels/cell_integrals/window.hpp"

namespace glint::cell_integrals {

void check(const CellIntegrals::Args& args) {
  if (args.sums.size() != args.targets.size()) {
    throw std::invalid_argument("cell_integrals needs one entry of sums for each target");
  }
  if (!(args.background > 0 && args.reach > 0)) {
    throw std::invalid_argument("cell_integrals needs a background proportion and a reach > 0");
  }
  if (args.rule.threshold < 0 && !args.rule.subtract) {
    throw std::invalid_argument("cell_integrals needs a threshold >= 0, so that no cell is < 0");
  }
  const auto bad = [](const HistogramTarget& t) {
    return !(t.sigma_x > 0 && t.sigma_y > 0 && t.proportion >= 0);
  };
  if (std::any_of(args.targets.begin(), args.targets.end(), bad)) {
    throw std::invalid_argument("cell_integrals needs targets of sigma > 0 and proportion >= 0");
  }
}

Totals totals_of(const CellIntegrals::Args& args, std::span<const PartialSums> partial) {
  const double pixels = static_cast<double>(args.frame.width) * args.frame.height;
  const double flat = args.background / cells_of(args);
  Totals totals{flat * args.total.shown, flat * (pixels - args.total.shown)};
  for (std::size_t k = 0; k < partial.size(); ++k) {
    const double pi = args.targets[k].proportion;
    totals.shown += pi * (partial[k].probability - partial[k].missing);  // P-HPMHT (8)
    totals.missing += pi * partial[k].missing;
  }
  totals.missing_weight = totals.shown > 0 ? args.total.norm / totals.shown : 0;  // (9)
  return totals;
}

TargetSums normalised(const HistogramTarget& t, const PartialSums& p, double missing_weight) {
  const double count = p.count + missing_weight * p.missing;
  const double shown = p.probability - p.missing;
  if (!(count > 0)) {
    return {0, t.x, t.y, t.sigma_x * t.sigma_x, t.sigma_y * t.sigma_y, shown};
  }
  const double scale = 1 / count;
  return {t.proportion * count,
          t.x + (p.x + missing_weight * p.missing_x) * scale,
          t.y + (p.y + missing_weight * p.missing_y) * scale,
          (p.xx + missing_weight * p.missing_xx) * scale,
          (p.yy + missing_weight * p.missing_yy) * scale,
          shown};
}

void fill_mixture(const CellIntegrals::Args& args, const Totals& totals, double log_ratio_sum) {
  if (args.mixture == nullptr) return;
  double counts = 0;
  for (const TargetSums& s : args.sums) counts += s.count;
  // Every expected measurement belongs to a target or to the background.
  const double expected = args.total.norm + totals.missing_weight * totals.missing;
  *args.mixture = {std::max(0.0, expected - counts), totals.shown, 0};
  if (!args.log_likelihood) return;
  args.mixture->log_likelihood =
      args.total.norm * std::log(args.background / cells_of(args)) + log_ratio_sum;
}

}  // namespace glint::cell_integrals
