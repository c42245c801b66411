// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <vector>

#include "glint/kernels/core/frame.hpp"

namespace glint {

/// Images that go out as Frames and come back when nobody holds them any more, so that a warm
/// stream allocates nothing.
class FramePool {
 public:
  /// An image of this size that nobody else holds; its pixels are those of an earlier use.
  std::shared_ptr<Image<float>> take(int width, int height) {
    for (auto& image : images_) {
      if (image.use_count() != 1) continue;
      // Copying and dropping a reference orders the last holder's reads before our writes;
      // use_count() alone does not.
      std::shared_ptr<Image<float>> ours = image;
      ours.reset();
      if (image->width() == width && image->height() == height) return image;
    }
    return images_.emplace_back(std::make_shared<Image<float>>(width, height));
  }
  std::size_t size() const { return images_.size(); }

 private:
  std::vector<std::shared_ptr<Image<float>>> images_;
};

}  // namespace glint
