// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/imm_pda_ai/pda.hpp"

#include <algorithm>
#include <cmath>

namespace glint {

double pda_weights(std::span<const double> log_ratio, double miss, std::span<double> beta) {
  double largest = std::log(miss);
  for (const double r : log_ratio) largest = std::max(largest, r);
  beta[0] = std::exp(std::log(miss) - largest);
  double sum = beta[0];
  for (std::size_t i = 0; i < log_ratio.size(); ++i) {
    beta[i + 1] = std::exp(log_ratio[i] - largest);
    sum += beta[i + 1];
  }
  for (std::size_t i = 0; i <= log_ratio.size(); ++i) beta[i] /= sum;
  return largest + std::log(sum);
}

}  // namespace glint
