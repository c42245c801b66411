// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "glint/engine/config.hpp"
#include "glint/engine/scan.hpp"
#include "glint/kernels/core/device.hpp"
#include "glint/kernels/prepare_frame/prepare_frame.hpp"

namespace glint {

/// How raw pixels become whitened frames.
struct FramesConfig {
  std::string polarity = "bright";      ///< bright, dark, both
  std::string background = "temporal";  ///< temporal, registered, spatial, none
  // ... the rest is the preparer's: see describe()
};
void describe(FieldList& list, FramesConfig& config);

/// Turns a stream of raw frames into whitened ones: grey, background, noise sigma, z. Causal.
class FramePreparer {
 public:
  FramePreparer(const FramesConfig& config, const Device& device);
  ~FramePreparer();
  FramePreparer(FramePreparer&&) noexcept;

  /// The next frame of the stream. Fills frame-related members of a Scan (raw, whitened,
  /// noise_sigma). Throws std::invalid_argument if the size differs from the first frame's.
  Scan prepare(const RawPixels& raw, std::int64_t frame, double time);
  /// What was estimated, for the summary ("noise sigma 4.2 grey levels").
  std::vector<std::string> notes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace glint
