// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace glint::bench {

/// By target of a group: the number of a hypothesis, or an option of the scan.
using PlainEvent = std::vector<int>;
using PlainEvents = std::map<PlainEvent, double>;

/// Groups of 0..count-1 that hang together by `pairs`, each rising, by their first.
std::vector<std::vector<int>> components(int count, const std::vector<std::pair<int, int>>& pairs);

/// Leaves at most `most` events, the weightiest, none lighter than `least` times all; weights are
/// scaled to sum to 1.
void keep_best(PlainEvents& events, std::size_t most, double least);

}  // namespace glint::bench
