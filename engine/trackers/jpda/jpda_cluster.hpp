// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace glint {

/// A point of a cluster that a target of it may have caused.
struct JpdaLink {
  std::uint32_t target, point;  ///< numbered within the cluster
  double weight;                ///< over that of the point as clutter
};

/// Targets that hang together by points that they share. The weights of a target may have any
/// common factor.
struct JpdaCluster {
  std::span<const double> missed;   ///< weight of having no point, by target
  std::span<const JpdaLink> links;  ///< by target
  std::size_t points = 0;
};

}  // namespace glint
