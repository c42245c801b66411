// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include "glint/engine/scenario/truth.hpp"
#include "glint/engine/tracks/track_log.hpp"

namespace glint {

/// A sum over points and how many they are.
struct PointSum {
  double sum = 0;
  std::int64_t points = 0;
  double mean() const { return sum / static_cast<double>(points); }  ///< NaN for none
};

/// How true what tracks state about themselves is.
struct Consistency {
  /// Normalised estimation error squared, e' P^-1 e, of the confirmed points that have a truth
  /// within reach: of the position, of position and velocity. Right covariances give a mean of 2
  /// and of 4; more is too sure, less is too careful.
  PointSum position_nees, state_nees;
  /// Squared error of the stated existence probability against 1 with a truth within reach, else 0,
  /// of all points, and how many of them have one.
  PointSum existence_error;
  std::int64_t real = 0;

  /// Mean of existence_error, Brier's score.
  double brier() const { return existence_error.mean(); }
  /// Brier's score of who states of every point how frequent truths are.
  double brier_of_base_rate() const;
};

/// Each point's truth is the nearest one, at most `reach` [px] away. Points without existence, and
/// without (or with a singular) covariance, are left out of what needs it; so are truths without
/// velocity. Scored are frames 0 to `frames` - 1; without it, all. Throws std::invalid_argument as
/// evaluate() does, for a negative frame and for too many.
Consistency consistency(std::span<const TruthPoint> truth, std::span<const TrackPoint> tracks,
                        double reach = 3, std::optional<std::int64_t> frames = {});

}  // namespace glint
