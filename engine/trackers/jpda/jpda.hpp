// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "glint/engine/trackers/jpda/disjoint_sets.hpp"
#include "glint/engine/trackers/jpda/jpda_cluster.hpp"
#include "glint/engine/trackers/jpda/jpda_exact.hpp"
#include "glint/engine/trackers/jpda/jpda_loopy.hpp"

namespace glint {

/// A point that a target may have caused.
struct JpdaPair {
  std::uint32_t target, point;
  double log_weight;  ///< ln(P_D p(z | target)) [1/volume]
};

/// What is known of the points that no target caused.
struct JpdaClutter {
  /// Their number is Poisson with `density`, or any number is as likely as any other over `volume`.
  enum class Number { poisson, any };
  Number number = Number::poisson;
  double density = 1;  ///< poisson: lambda [1/volume], > 0
  double volume = 1;   ///< any: of all gates together, V, > 0
};

/// How marginals were found.
struct JpdaReport {
  std::size_t clusters = 0;     ///< groups of targets that share points, with one point at least
  std::size_t approximate = 0;  ///< of them by belief propagation, too large for the exact sum
  std::size_t largest = 0;      ///< targets of the largest
  int iterations = 0;           ///< most of belief propagation
};

/// Joint probabilistic data association: the probability that each point is each target's, summed
/// over all events in which a target has at most one point and a point one target at most. The
/// weight of an event with d of m points assigned is K(d) times those of its assignments, P-JPDA
/// (10)-(14), with K(d) = lambda^-d, or V^d / [m (m-1) ... (m-d+1)] if any number of false points
/// is as likely as any other; the printed phi! is never formed.
///
/// Groups of targets that share no point are summed apart. That is exact for Poisson clutter;
/// otherwise each group keeps its weight as a polynomial in the number assigned, and K(d) comes
/// last. A group whose sum would need more than `table` numbers (targets + 1 times 2^points, or
/// points + 1 times 2^targets, the smaller) is solved by loopy belief propagation instead, and
/// clutter of any number is then Poisson with the density (m - d + 1) / V at the mean d. Calls of
/// the size of an earlier one allocate nothing.
class Jpda {
 public:
  static constexpr std::size_t kTable = std::size_t{1} << 18;
  explicit Jpda(std::size_t table = kTable) : table_(table) {}

  /// `log_missed`: ln(1 - P_D), by target; `pairs`: by rising target, each point once a target. A
  /// target that cannot have any point, nor none, counts as missed.
  JpdaReport run(std::span<const double> log_missed, std::span<const JpdaPair> pairs,
                 const JpdaClutter& clutter);

  /// Probability that a target has none of the points, by target.
  std::span<const double> missed() const { return missed_; }
  /// Probability that the point is the target's, by pair.
  std::span<const double> associated() const { return associated_; }

 private:
  struct Range {
    std::size_t first_target, targets, first_link, links, points;
  };
  void find_clusters(std::span<const JpdaPair> pairs);
  void number_points(std::span<const JpdaPair> pairs);
  void weigh(std::span<const double> log_missed, std::span<const JpdaPair> pairs, double log_ratio);
  JpdaCluster cluster(const Range& range) const;
  bool exact(const Range& range) const;
  void solve(const Range& range, std::span<const double> factor, JpdaReport& report);
  void solve_any_number();
  void spread();

  std::size_t table_;
  JpdaExact exact_;
  JpdaLoopy loopy_;
  std::vector<double> missed_, associated_;
  // Of the pairs at hand: `pair_begin_` by target, and what belongs to the clusters one after
  // another: targets, links (of pairs `link_pair_`), and their marginals.
  std::vector<std::size_t> pair_begin_;
  DisjointSets sets_;  // of targets
  std::vector<std::uint32_t> owner_, order_, target_of_, local_, link_pair_;
  std::vector<Range> ranges_;
  std::vector<JpdaLink> links_;
  std::vector<double> weight_missed_, own_missed_, own_linked_;
  std::size_t points_ = 0;  // in some gate, m
  // Polynomials of clusters, K(d) after each of them, and their product before one.
  std::vector<double> polynomial_, polynomials_, after_, before_, product_, factor_;
};

}  // namespace glint
