// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <optional>

#include "glint/engine/scheduler.hpp"
#include "glint/kernels/core/device.hpp"

namespace glint {

/// Another source's frames, in grey, with white Gaussian noise added: float, not clipped. The noise
/// is a function of seed, frame and pixel.
class NoisySource : public Source {
 public:
  /// `sigma` in grey levels.
  NoisySource(std::unique_ptr<Source> source, double sigma, std::uint64_t seed,
              const Device& device);
  std::optional<SourceFrame> next() override;
  std::optional<std::int64_t> frame_count() const override { return source_->frame_count(); }
  double frame_rate() const override { return source_->frame_rate(); }

 private:
  std::unique_ptr<Source> source_;
  float sigma_;
  std::uint64_t seed_, frame_ = 0;
  Device device_;
};

}  // namespace glint
