// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>

#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"

namespace glint::bench {

/// The pixel likelihood as it is put together from OpenCV: sepFilter2D, convertTo, compare,
/// findNonZero, on as many threads as OpenCV likes. Throws std::logic_error in a build without
/// OpenCV.
class OpenCvPixelLikelihood {
 public:
  static bool available();
  explicit OpenCvPixelLikelihood(const PixelLikelihood::Args& args);
  void correlate() const;  ///< sepFilter2D alone
  void run() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace glint::bench
