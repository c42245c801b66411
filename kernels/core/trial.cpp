// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/trial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace glint {
namespace {

bool inside(double want, double got, Tolerance t) {
  if (want == got || (std::isnan(want) && std::isnan(got))) return true;
  return std::isfinite(want) && std::abs(got - want) <= t.absolute + t.relative * std::abs(want);
}

}  // namespace

std::vector<Mismatch> compare(const std::vector<Output>& want, const std::vector<Output>& got) {
  std::vector<Mismatch> found;
  for (std::size_t o = 0; o < std::max(want.size(), got.size()); ++o) {
    const auto missing = std::numeric_limits<double>::quiet_NaN();
    if (o >= want.size() || o >= got.size()) {
      found.push_back({o < want.size() ? want[o].name : got[o].name, 0, missing, missing});
      continue;
    }
    const auto &a = want[o].values, &b = got[o].values;
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
      const double x = i < a.size() ? a[i] : missing, y = i < b.size() ? b[i] : missing;
      if (i < a.size() && i < b.size() && inside(x, y, want[o].tolerance)) continue;
      found.push_back({want[o].name, i, x, y});
      break;
    }
  }
  return found;
}

}  // namespace glint
