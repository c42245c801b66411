// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
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
#include "glint/kernels/core/gl_residents.hpp"
#include "glint/kernels/core/gl_staging.hpp"

namespace glint::gl {

class Queue;

/// Memory of the device: the queue's own, which goes back to its pool, or part of a resident
/// region.
class Buffer {
 public:
  Buffer(Buffer&& other) noexcept
      : queue_(std::exchange(other.queue_, nullptr)), place_(other.place_), bytes_(other.bytes_) {}
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  Buffer& operator=(Buffer&& other) noexcept {
    std::swap(queue_, other.queue_), std::swap(place_, other.place_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~Buffer();

 private:
  friend class Queue;
  Buffer(Queue* owner, Place place, std::size_t bytes)
      : queue_(owner), place_(place), bytes_(bytes) {}
  Queue* queue_;  ///< null if it is not the buffer's to give back
  Place place_;
  std::size_t bytes_;  ///< that passes see
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

  /// Most bytes that a pass sees of one buffer: larger problems are to be cut. From any thread.
  std::size_t max_bytes() const { return max_bytes_; }
  /// Makes the limit smaller than the driver's.
  void limit(std::size_t bytes);

  /// See device_traffic.hpp.
  void time_traffic(bool timed) { timed_ = timed, traffic_ = {}; }
  const DeviceTraffic& traffic() const { return traffic_; }
  double copy_seconds(std::size_t bytes, int times);

  /// Uninitialised memory for `count` values.
  template <class T>
  Buffer buffer(std::size_t count) {
    return take(count * sizeof(T));
  }
  /// Values, or an image's rows without the padding between them, for passes to read: where they
  /// are if they are resident, else a copy. A pass that changes what is not resident changes the
  /// copy.
  template <class T>
  Buffer upload(std::span<T> values) {
    return upload(region_of(values));
  }
  template <class T>
  Buffer upload(ImageView<T> image) {
    return upload(region_of(image));
  }
  /// Uninitialised memory for what is to become values, or rows of an image, by read(): where they
  /// are if they are resident.
  template <class T>
  Buffer output(std::span<T> values) {
    return output(region_of(values));
  }
  template <class T>
  Buffer output(ImageView<T> image) {
    return output(region_of(image));
  }
  /// Sets the buffer's values from number `first` on.
  template <class T>
  void write(const Buffer& to, std::span<T> values, std::size_t first = 0) {
    write(to, region_of(values), first * sizeof(T));
  }
  template <class T>
  void write(const Buffer& to, ImageView<T> image, std::size_t first = 0) {
    write(to, region_of(image), first * sizeof(T));
  }
  /// Fills `values` from value number `first` of the buffer.
  template <class T>
  void read(const Buffer& from, std::span<T> values, std::size_t first = 0) {
    read(from, region_of(values), first * sizeof(T));
  }
  /// Fills an image from rows without padding.
  template <class T>
  void read(const Buffer& from, ImageView<T> image) {
    read(from, region_of(image), 0);
  }

  /// See Device::make_resident(): from now on the region lives on the device, uninitialised.
  void make_resident(const Region& region);
  /// See Device::stage(): the region, whose bytes `slot` holds, lives there until drop(). False,
  /// and the slot is given back, if it lives somewhere already. `seconds` is what filling took.
  bool keep_staged(const Region& region, const StagingSlot& slot, double seconds);
  Staging& staging() { return staging_; }
  void drop(const std::byte* region);
  /// From the host to the device and back, of resident regions; others stay as they are.
  void send(const Region& region);
  void fetch(const Region& region);
  /// Copies rows of the same number and length, wherever they live.
  void copy(const Region& from, const Region& to) { read(upload(from), to, 0); }
  void fill(std::span<float> values, float value);
  /// For tests: what is kept from now on is not, or has its bytes on the host spoilt at every
  /// write, so that nothing can rest on them.
  enum class Keeping { plain, never, spoiling };
  void set_keeping(Keeping keeping) { keeping_ = keeping; }

  /// Runs `pass` of a shader for items 0 .. `items` - 1: item() of prelude.glsl. Parameters, a
  /// plain struct of 4-byte members, are at binding 0, the buffers from 1 on.
  template <class Parameters>
  void run(const Shader& shader, std::string_view pass, std::size_t items,
           const Parameters& parameters, std::initializer_list<const Buffer*> buffers) {
    static_assert(std::is_trivially_copyable_v<Parameters> && alignof(Parameters) == 4);
    const Buffer first = buffer<Parameters>(1);
    write(first, std::span(&parameters, 1));
    dispatch(shader, pass, items, first, buffers);
  }

 private:
  friend class Buffer;

  Buffer take(std::size_t bytes);
  Buffer allocate(std::size_t bytes);
  bool reserve(unsigned id, std::size_t capacity);
  void drop_pool();
  Buffer upload(const Region& region);
  Buffer output(const Region& region);
  std::optional<Buffer> borrow(const Region& region);
  void write(const Buffer& to, const Region& region, std::size_t offset);
  void read(const Buffer& from, const Region& region, std::size_t offset);
  void write_host(Place to, const Region& region);
  void read_host(Place from, const Region& region);
  void copy(Place from, Place to, std::size_t bytes);
  void bind(unsigned binding, const Buffer& buffer);
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
  std::atomic<std::size_t> max_bytes_ = std::numeric_limits<std::size_t>::max();
  bool timed_ = false;
  DeviceTraffic traffic_;
  std::vector<Place> pool_;
  Residents residents_;
  Staging staging_;
  std::vector<StagingSlot> staged_;  ///< that regions live in
  Keeping keeping_ = Keeping::plain;
  Programs programs_;
  std::string debug_error_;  ///< first message of the driver since the last check
};

/// Where a pass may begin to see any buffer [bytes].
inline constexpr std::size_t kAligned = 256;
/// What may help where a device is out of memory.
inline constexpr const char* kSmallerRemedy =
    "take smaller frames, fewer particles or --device tbb";
/// "3 MB".
std::string size_text(std::size_t bytes);

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
