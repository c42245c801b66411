// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <stdexcept>

#include "glint/kernels/cell_integrals/window.hpp"

namespace glint::cell_integrals {
namespace {

TargetSums normalised(const HistogramTarget& t, const PartialSums& p, double missing_weight) {
  const double count = p.count + missing_weight * p.missing;
  const double shown = p.probability - p.missing;
  if (!(count > 0)) {
    return {0, t.x, t.y, t.sigma_x * t.sigma_x, t.sigma_y * t.sigma_y, shown};
  }
  return {t.proportion * count,
          t.x + (p.x + missing_weight * p.missing_x) / count,
          t.y + (p.y + missing_weight * p.missing_y) / count,
          (p.xx + missing_weight * p.missing_xx) / count,
          (p.yy + missing_weight * p.missing_yy) / count,
          shown};
}

}  // namespace

void check(const CellIntegrals::Args& args) {
  if (args.sums.size() != args.targets.size()) {
    throw std::invalid_argument("cell_integrals needs one entry of sums for each target");
  }
  if (!(args.background > 0 && args.reach > 0)) {
    throw std::invalid_argument("cell_integrals needs a background proportion and a reach > 0");
  }
  const auto bad = [](const HistogramTarget& t) {
    return !(t.sigma_x > 0 && t.sigma_y > 0 && t.proportion >= 0);
  };
  if (std::any_of(args.targets.begin(), args.targets.end(), bad)) {
    throw std::invalid_argument("cell_integrals needs targets of sigma > 0 and proportion >= 0");
  }
}

void finish(const CellIntegrals::Args& args, std::span<const PartialSums> partial,
            double log_ratio_sum) {
  const double cells = cells_of(args);
  double shown = args.background * args.total.shown / cells;  // P_t, P-HPMHT (8)
  double missing = args.background *
                   (static_cast<double>(args.frame.width) * args.frame.height - args.total.shown) /
                   cells;
  for (std::size_t k = 0; k < partial.size(); ++k) {
    const double pi = args.targets[k].proportion;
    shown += pi * (partial[k].probability - partial[k].missing);
    missing += pi * partial[k].missing;
  }
  const double missing_weight = shown > 0 ? args.total.norm / shown : 0;  // P-HPMHT (9)
  double counts = 0;
  for (std::size_t k = 0; k < partial.size(); ++k) {
    args.sums[k] = normalised(args.targets[k], partial[k], missing_weight);
    counts += args.sums[k].count;
  }
  if (args.mixture == nullptr) return;
  // Every expected measurement belongs to a target or to the background.
  const double expected = args.total.norm + missing_weight * missing;
  args.mixture->background = std::max(0.0, expected - counts);
  args.mixture->shown = shown;
  args.mixture->log_likelihood =
      args.log_likelihood ? args.total.norm * std::log(args.background / cells) + log_ratio_sum : 0;
}

}  // namespace glint::cell_integrals
