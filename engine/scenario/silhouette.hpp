// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "glint/engine/scenario/path.hpp"
#include "glint/kernels/core/frame.hpp"

namespace glint {

/// What an extended target covers at one time.
struct Patch {
  Box box;  ///< pixels that follow, row by row; may lie outside the frame
  std::vector<float> share,
      grey;  ///< covered share of each pixel, and grey level of what covers it
};

enum class Aircraft { jet, helicopter };

/// A dark aircraft seen from below: extended, not Gaussian, of a shape and a shading that vary with
/// time. A jet rolls, a helicopter's rotor turns, and a band of light wanders along both.
struct Silhouette {
  Aircraft kind = Aircraft::jet;
  double area = 200;      ///< [px^2], the same at all times
  double reciprocal = 2;  ///< mean of 255 / I over the covered area, P-HPMHT (2)
  double sky = 165;       ///< grey level behind it
  double phase = 0;       ///< [rad] of roll, rotor and shading at age 0

  /// The target with its centroid at `k.x`, `k.y`, heading along its velocity. `age` [frames].
  Patch at(double age, const Kinematics& k) const;
};

/// Draws the patch over what is there; parts outside the image are left out.
void paint(const Patch& patch, ImageView<float> image);

}  // namespace glint
