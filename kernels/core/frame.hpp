// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "glint/kernels/core/aligned.hpp"

namespace glint {

/// Borrowed view of a single-channel image; pixel (0,0) is the centre of the top-left pixel, x to
/// the right, y down. Rows are `pitch` elements apart.
template <class T>
struct ImageView {
  T* data = nullptr;
  int width = 0, height = 0;  ///< [px]
  std::ptrdiff_t pitch = 0;   ///< [elements]

  T* row(int y) const { return data + y * pitch; }
  T& operator()(int x, int y) const { return data[y * pitch + x]; }
  bool empty() const { return width <= 0 || height <= 0; }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  operator ImageView<const T>() const requires(!std::is_const_v<T>) {
    return {data, width, height, pitch};
  }
};

using FrameView = ImageView<const float>;

/// Pixels that an Image keeps around its own, so that windows and vector loads may run over the
/// edge. They hold zeros for the life of the image: whoever writes an image writes only its own
/// pixels.
inline constexpr int kImageMargin = 16;

/// Elements from one row to the next: room for the margin, rows on 64-byte boundaries, and never a
/// power of two, which would put a column of pixels into one cache set (2x for particles at 4096).
inline std::ptrdiff_t padded_pitch(int width, std::size_t element_size) {
  const std::size_t line = 64 / element_size;
  std::size_t pitch = (static_cast<std::size_t>(width) + kImageMargin + line - 1) / line * line;
  while ((pitch & (pitch - 1)) == 0) pitch += line;
  return static_cast<std::ptrdiff_t>(pitch);
}

/// Owning image with padded pitch and a zero margin of kImageMargin pixels on every side.
template <class T>
class Image {
 public:
  Image() = default;
  /// Throws std::invalid_argument for a negative size.
  Image(int width, int height) : width_(width), height_(height) {
    if (width < 0 || height < 0) throw std::invalid_argument("image size must not be negative");
    pitch_ = padded_pitch(width, sizeof(T));
    const auto rows = static_cast<std::size_t>(height) + 2 * kImageMargin;
    storage_.assign(rows * static_cast<std::size_t>(pitch_) + 2 * kLine, T{});
  }
  int width() const { return width_; }
  int height() const { return height_; }
  ImageView<T> view() { return {storage_.data() + origin(), width_, height_, pitch_}; }
  ImageView<const T> view() const { return {storage_.data() + origin(), width_, height_, pitch_}; }
  operator ImageView<const T>() const { return view(); }

 private:
  // The left margin of a row is the right padding of the row above it.
  static constexpr std::size_t kLine = 64 / sizeof(T) * ((kImageMargin * sizeof(T) + 63) / 64);
  std::size_t origin() const {
    return storage_.empty() ? 0 : kImageMargin * static_cast<std::size_t>(pitch_) + kLine;
  }

  int width_ = 0, height_ = 0;
  std::ptrdiff_t pitch_ = 0;
  AlignedVector<T> storage_;
};

/// Immutable float image shared by everyone who looks at the frame; the only shared object of the
/// house.
class Frame {
 public:
  Frame() = default;
  explicit Frame(Image<float>&& image)
      : image_(std::make_shared<const Image<float>>(std::move(image))) {}
  explicit Frame(std::shared_ptr<const Image<float>> image) : image_(std::move(image)) {}
  /// An image whose pixels are still on a device: `fetch` brings them when someone asks.
  Frame(std::shared_ptr<const Image<float>> image, std::function<void()> fetch)
      : image_(std::move(image)), arrival_(std::make_shared<Arrival>(std::move(fetch))) {}
  /// From any thread. Throws what fetching throws.
  FrameView view() const {
    if (arrival_) arrival_->await();
    return for_kernels();
  }
  /// The same pixels for kernels alone, which find them on the device: the host's may not be there.
  FrameView for_kernels() const { return image_ ? image_->view() : FrameView{}; }
  int width() const { return image_ ? image_->width() : 0; }
  int height() const { return image_ ? image_->height() : 0; }
  explicit operator bool() const { return image_ != nullptr; }

 private:
  /// Fetches once; again if that threw. std::call_once() would say it shorter, but hangs after an
  /// exception where pthread_once() does, as under ThreadSanitizer.
  class Arrival {
   public:
    explicit Arrival(std::function<void()> fetch) : fetch_(std::move(fetch)) {}
    void await() {
      if (here_.load(std::memory_order_acquire)) return;
      const std::lock_guard lock(mutex_);
      if (here_.load(std::memory_order_relaxed)) return;
      fetch_();
      here_.store(true, std::memory_order_release);
    }

   private:
    std::function<void()> fetch_;
    std::mutex mutex_;
    std::atomic<bool> here_ = false;
  };
  std::shared_ptr<const Image<float>> image_;
  std::shared_ptr<Arrival> arrival_;
};

/// Pixels x0 <= x < x1, y0 <= y < y1.
struct Box {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
  bool operator==(const Box&) const = default;
};

}  // namespace glint
