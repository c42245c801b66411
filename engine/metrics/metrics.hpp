// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <vector>

namespace glint {

/// [px]
struct Position {
  double x = 0, y = 0;
};

/// OSPA [px] (Schuhmacher, Vo and Vo 2008): distance^p = localisation^p + cardinality^p. Two empty
/// sets are 0 apart.
struct Ospa {
  double distance = 0, localisation = 0, cardinality = 0;
};
/// `cutoff` c > 0 [px], `order` p >= 1; throws std::invalid_argument otherwise.
Ospa ospa(std::span<const Position> truth, std::span<const Position> estimates, double cutoff,
          double order);

/// GOSPA [px] with alpha = 2 (Rahmathullah, Garcia-Fernandez and Svensson 2017): distance^p =
/// localisation^p + missed^p + false^p, where a missed or a false target costs c^p / 2.
struct Gospa {
  double distance = 0, localisation = 0, missed = 0, false_alarms = 0;
};
Gospa gospa(std::span<const Position> truth, std::span<const Position> estimates, double cutoff,
            double order);

/// A truth and an estimate of the same frame that belong together.
struct Match {
  int truth = 0, estimate = 0;  ///< indices
  double distance = 0;          ///< [px], <= cutoff
};
/// The pairs of the optimal assignment (distances to the power `order`, capped at the cut-off) that
/// lie within the cut-off, by truth.
std::vector<Match> match(std::span<const Position> truth, std::span<const Position> estimates,
                         double cutoff, double order);

}  // namespace glint
