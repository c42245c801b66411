// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/filters/imm.hpp"

#include <cmath>
#include <stdexcept>

#include "glint/engine/filters/imm_steps.hpp"
#include "glint/engine/number_text.hpp"

namespace glint {

std::vector<std::string> normalise_rows(Switching& switching) {
  if (!(switching.minCoeff() >= 0) || !(switching.rowwise().sum().minCoeff() > 0)) {
    throw std::invalid_argument("switching probabilities must be positive, and no row zero");
  }
  std::vector<std::string> notes;
  for (Eigen::Index i = 0; i < switching.rows(); ++i) {
    const double sum = switching.row(i).sum(), rounded = std::round(sum * 1e6) / 1e6;
    if (rounded != 1) {
      notes.push_back("row " + std::to_string(i + 1) + " of the switching probabilities sums to " +
                      number_text(rounded) + " and was scaled to 1");
    }
    switching.row(i) /= sum;
  }
  return notes;
}

Switching staying(std::size_t models, double stay) {
  const auto count = static_cast<Eigen::Index>(models);
  const double go = count > 1 ? (1 - stay) / static_cast<double>(count - 1) : 0;
  Switching switching = Switching::Constant(count, count, go);
  switching.diagonal().setConstant(count > 1 ? stay : 1);
  return switching;
}

ModeProbability weighed(const ModeProbability& probability,
                        std::span<const double> log_likelihood) {
  const double largest = *std::max_element(log_likelihood.begin(), log_likelihood.end());
  if (!std::isfinite(largest)) return probability;
  double sum = 0;
  ModeProbability next = probability;
  for (std::size_t j = 0; j < next.size(); ++j) {
    next[j] *= std::exp(log_likelihood[j] - largest);
    sum += next[j];
  }
  if (!(sum > 0)) return probability;
  for (double& p : next) p /= sum;
  return next;
}

template class ImmOf<2>;

}  // namespace glint
