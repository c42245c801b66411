// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <utility>
#include <vector>

#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/resident_memory.hpp"

namespace glint {

/// Images, resident on the device, that go out as Frames and come back when nobody holds them any
/// more, so that a warm stream allocates nothing.
class FramePool {
 public:
  explicit FramePool(const Device& device) : device_(device) {}

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
    const auto made = std::make_shared<ResidentImage<float>>(width, height, device_);
    return images_.emplace_back(made, &made->image());
  }
  /// A Frame of an image of this pool that kernels have written.
  Frame frame(std::shared_ptr<const Image<float>> image) const {
    if (device_.kind() != DeviceKind::egl) return Frame(std::move(image));
    const FrameView pixels = image->view();
    return Frame(std::move(image), [device = device_, pixels] { device.fetch(pixels); });
  }
  std::size_t size() const { return images_.size(); }

 private:
  Device device_;
  std::vector<std::shared_ptr<Image<float>>> images_;
};

}  // namespace glint
