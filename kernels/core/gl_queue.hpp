// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "glint/kernels/core/device_traffic.hpp"
#include "glint/kernels/core/egl_devices.hpp"
#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/function_ref.hpp"
#include "glint/kernels/core/gl_api.hpp"
#include "glint/kernels/core/gl_programs.hpp"

namespace glint::gl {

class Queue;

/// Memory of the device; goes back to the queue's pool.
class Buffer {
 public:
  Buffer(Buffer&& other) noexcept
      : queue_(std::exchange(other.queue_, nullptr)), id_(other.id_), capacity_(other.capacity_) {}
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  Buffer& operator=(Buffer&& other) noexcept {
    std::swap(queue_, other.queue_), std::swap(id_, other.id_);
    std::swap(capacity_, other.capacity_);
    return *this;
  }
  ~Buffer();

 private:
  friend class Queue;
  Buffer(Queue& queue, unsigned id, std::size_t capacity)
      : queue_(&queue), id_(id), capacity_(capacity) {}
  Queue* queue_;
  unsigned id_;
  std::size_t capacity_;  ///< [bytes]
};

/// Rows [first, last) of a frame, made from rows [top, bottom).
struct Band {
  int first, last, top, bottom;
};

/// Rows [first, last) of an image.
template <class T>
ImageView<T> rows(const ImageView<T>& image, int first, int last) {
  return {image.row(first), image.width, last - first, image.pitch};
}

/// What kernels say to a context, on its thread only. Work is done in the order that it is given;
/// reading waits for it. Every function throws std::runtime_error that names the device and the
/// remedy if memory runs out, the context is lost or a shader does not compile.
class Queue {
 public:
  Queue(const Api& api, const EglDevice& device, ProgramCache cache, bool debug);
  ~Queue();
  Queue(const Queue&) = delete;
  Queue& operator=(const Queue&) = delete;

  /// Most bytes that a pass sees of one buffer: larger problems are to be cut.
  std::size_t max_bytes() const { return max_bytes_; }
  /// Makes the limit smaller than the driver's.
  void limit(std::size_t bytes) { max_bytes_ = std::min(max_bytes_, bytes); }

  /// See device_traffic.hpp.
  void time_traffic(bool timed) { timed_ = timed, traffic_ = {}; }
  const DeviceTraffic& traffic() const { return traffic_; }
  double copy_seconds(std::size_t bytes, int times);

  /// Uninitialised memory for `count` values.
  template <class T>
  Buffer buffer(std::size_t count) {
    return take(count * sizeof(T));
  }
  template <class T>
  Buffer upload(std::span<const T> values) {
    Buffer to = buffer<T>(values.size());
    write(to, values);
    return to;
  }
  /// Sets the buffer's values from number `first` on.
  template <class T>
  void write(const Buffer& to, std::span<const T> values, std::size_t first = 0) {
    write_bytes(to, first * sizeof(T), values.size_bytes(),
                [&](void* at) { std::copy(values.begin(), values.end(), static_cast<T*>(at)); });
  }
  /// Sets the buffer's values from number `first` on to an image's rows, without the padding
  /// between them.
  template <class T>
  void write(const Buffer& to, ImageView<const T> image, std::size_t first = 0) {
    const auto width = static_cast<std::size_t>(image.width);
    const std::size_t bytes = width * static_cast<std::size_t>(image.height) * sizeof(T);
    write_bytes(to, first * sizeof(T), bytes, [&](void* at) {
      auto* row = static_cast<T*>(at);
      for (int y = 0; y < image.height; ++y, row += width) std::copy_n(image.row(y), width, row);
    });
  }
  /// Rows of an image without the padding between them.
  template <class T>
  Buffer upload(ImageView<const T> image) {
    Buffer to =
        buffer<T>(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    write(to, image);
    return to;
  }
  /// Fills `values` from value number `first` of the buffer.
  template <class T>
  void read(const Buffer& from, std::span<T> values, std::size_t first = 0) {
    read_bytes(from, first * sizeof(T), values.size_bytes(), [&](const void* at) {
      std::copy_n(static_cast<const T*>(at), values.size(), values.begin());
    });
  }
  /// Fills an image from rows without padding.
  template <class T>
  void read(const Buffer& from, ImageView<T> image) {
    const auto width = static_cast<std::size_t>(image.width);
    const std::size_t bytes = width * static_cast<std::size_t>(image.height) * sizeof(T);
    read_bytes(from, 0, bytes, [&](const void* at) {
      const auto* row = static_cast<const T*>(at);
      for (int y = 0; y < image.height; ++y, row += width) std::copy_n(row, width, image.row(y));
    });
  }

  /// Turns `count` counts into the sums of those before them; returns the sum of all.
  std::uint32_t sum_before(const Buffer& counts, std::size_t count);

  /// Runs `pass` of a shader for items 0 .. `items` - 1: item() of prelude.glsl. Parameters, a
  /// plain struct of 4-byte members, are at binding 0, the buffers from 1 on.
  template <class Parameters>
  void run(const Shader& shader, std::string_view pass, std::size_t items,
           const Parameters& parameters, std::initializer_list<const Buffer*> buffers) {
    static_assert(std::is_trivially_copyable_v<Parameters> && alignof(Parameters) == 4);
    const Buffer first = upload(std::span<const Parameters>(&parameters, 1));
    dispatch(shader, pass, items, first, buffers);
  }

 private:
  friend class Buffer;
  struct Free {
    unsigned id;
    std::size_t capacity;
  };

  Buffer take(std::size_t bytes);
  bool reserve(unsigned id, std::size_t capacity);
  void drop_pool();
  void write_bytes(const Buffer& to, std::size_t offset, std::size_t bytes,
                   FunctionRef<void(void*)> fill);
  void read_bytes(const Buffer& from, std::size_t offset, std::size_t bytes,
                  FunctionRef<void(const void*)> copy);
  void dispatch(const Shader& shader, std::string_view pass, std::size_t items,
                const Buffer& parameters, std::initializer_list<const Buffer*> buffers);
  unsigned program(const Shader& shader, std::string_view pass);
  void timed(double& seconds, FunctionRef<void()> work);
  void check(const std::string& doing);
  [[noreturn]] void fail(const std::string& what) const { gl::fail(device_, what); }
  static void on_debug(Enum source, Enum type, unsigned id, Enum severity, int length,
                       const char* message, const void* user);

  const Api& api_;
  const EglDevice& device_;
  std::size_t max_bytes_ = 0;
  bool timed_ = false;
  DeviceTraffic traffic_;
  std::vector<Free> pool_;
  std::vector<std::uint32_t> scratch_;
  Programs programs_;
  std::string debug_error_;  ///< first message of the driver since the last check
};

/// Calls f(band) for bands that cover a frame from top to bottom, as high as fits where a row takes
/// `row_bytes` and needs `margin` rows above and below it.
template <class F>
void each_band(const Queue& queue, int height, std::size_t row_bytes, int margin, const F& f) {
  const auto fit = static_cast<std::int64_t>(queue.max_bytes() / row_bytes) - 2 * margin;
  const int most = static_cast<int>(std::clamp<std::int64_t>(fit, 1, height));
  for (int first = 0; first < height; first += most) {
    const int last = std::min(height, first + most);
    f(Band{first, last, std::max(0, first - margin), std::min(height, last + margin)});
  }
}

}  // namespace glint::gl
