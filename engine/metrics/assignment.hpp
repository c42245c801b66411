// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include <Eigen/Core>

namespace glint {

/// Assignment of rows to columns of least total cost: each row of a wide matrix, each column of a
/// tall one, is used once. Returns the column of each row, -1 for a row that stays free. Costs must
/// be finite. Exact; O(min^2 max) (Jonker and Volgenant's shortest augmenting paths).
std::vector<int> assign_least_cost(const Eigen::MatrixXd& costs);

}  // namespace glint
