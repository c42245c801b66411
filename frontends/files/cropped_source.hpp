// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <optional>
#include <utility>

#include "glint/engine/scheduler.hpp"

namespace glint {

/// Part of another source's frames; no pixel is copied.
class CroppedSource : public Source {
 public:
  /// `box` [px] must lie in the frames: next() throws std::runtime_error otherwise.
  CroppedSource(std::unique_ptr<Source> source, const Box& box)
      : source_(std::move(source)), box_(box) {}
  std::optional<SourceFrame> next() override;
  std::optional<std::int64_t> frame_count() const override { return source_->frame_count(); }
  double frame_rate() const override { return source_->frame_rate(); }

 private:
  std::unique_ptr<Source> source_;
  Box box_;
};

}  // namespace glint
