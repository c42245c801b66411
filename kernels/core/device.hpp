// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <concepts>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "glint/kernels/core/egl_devices.hpp"
#include "glint/kernels/core/function_ref.hpp"
#include "glint/kernels/core/kernel_clock.hpp"
#include "glint/kernels/core/region.hpp"
#include "glint/kernels/core/resident.hpp"
#include "glint/kernels/core/workers.hpp"

namespace glint {

enum class DeviceKind { serial, tbb, egl };

std::string_view name(DeviceKind kind);

/// A kernel: `K::Args` says what it reads and writes, `K::serial` is its reference, `K::tbb` is
/// fast.
template <class K>
concept Kernel = requires(const typename K::Args& args, Workers& workers) {
  { K::name } -> std::convertible_to<std::string_view>;
  K::serial(args);
  K::tbb(args, workers);
};

/// A kernel that also runs on OpenGL compute; others run on tbb there.
template <class K>
concept EglKernel = Kernel<K> && requires(const typename K::Args& args, gl::Context& context) {
  K::egl(args, context);
};

/// What a call needs at once on an egl device, for kernels that cannot be cut into pieces there.
struct WholeCall {
  std::size_t bytes;                  ///< of its largest buffer
  std::vector<Region> read, written;  ///< memory that may be resident
};

/// A kernel that runs on tbb if a call does not fit an egl device's buffers.
template <class K>
concept WholeEglKernel = EglKernel<K> && requires(const typename K::Args& args) {
  { K::whole(args) } -> std::same_as<WholeCall>;
};

/// Where kernels run. A new kind of device is an enumerator, a branch in run(), and a function in
/// each kernel worth it.
class Device {
 public:
  static Device serial() { return Device(DeviceKind::serial, 1, Isa::plain); }
  /// `threads` <= 0 means all of the machine's.
  static Device tbb(int threads = 0, Isa isa = best_isa()) {
    return Device(DeviceKind::tbb, threads, isa);
  }
  /// OpenGL compute without a display, opened through EGL; `threads` are for the kernels that it
  /// lacks. Throws as open_egl_device() does.
  static Device egl(int number = kAnyEglDevice, int threads = 0);
  /// `kind` is auto, serial, tbb, egl or egl:N; throws std::invalid_argument that lists them
  /// otherwise. auto is tbb.
  static Device named(std::string_view kind, int threads = 0);

  DeviceKind kind() const { return kind_; }
  Workers& workers() const { return *workers_; }
  gl::Context& context() const { return *context_; }  ///< of an egl device
  std::string description() const;

  /// The same device, with its kernels on `clock`, which must outlive it.
  Device timed_by(KernelClock& clock) const {
    Device timed(*this);
    timed.clock_ = &clock;
    return timed;
  }

  /// Makes memory (a std::span or an ImageView) resident on an egl device for as long as the result
  /// lives: kernels read and write it there, and the host's bytes are up to date only after a
  /// fetch() or send(), until the next such write. What they held before is not copied. On other
  /// devices nothing happens: kernels work in the host's memory. Throws std::logic_error if part of
  /// it is resident already, std::runtime_error if the device's memory runs out.
  template <class Memory>
  Resident make_resident(Memory memory) const {
    return make_region_resident(region_of(memory));
  }
  /// Copies memory to the device ahead of its use, for as long as the result lives: the calling
  /// thread copies it while the device works on, and kernels find it there. It must not change
  /// meanwhile. The host's bytes stay good.
  template <class Memory>
  Resident stage(Memory memory) const {
    return stage_region(region_of(memory));
  }
  /// The host changed this memory, or part of it: kernels are to see it.
  template <class Memory>
  void send(Memory memory) const {
    if (kind_ == DeviceKind::egl) send_region(region_of(memory));
  }
  /// The host is going to read this memory, or part of it.
  template <class Memory>
  void fetch(Memory memory) const {
    if (kind_ == DeviceKind::egl) fetch_region(region_of(memory));
  }
  /// Copies rows of the same number and length, wherever they live.
  template <class T>
  void copy(ImageView<const T> from, ImageView<T> to) const {
    copy_region(region_of(from), region_of(to));
  }
  /// Sets all values, wherever they live.
  void fill(std::span<float> values, float value) const;

  template <Kernel K>
  void run(const typename K::Args& args) const {
    if (clock_ == nullptr) return choose<K>(args);
    clock_->time(K::name, [&] { choose<K>(args); });
  }

 private:
  template <Kernel K>
  void choose(const typename K::Args& args) const {
    if (kind_ == DeviceKind::serial) return K::serial(args);
    if constexpr (WholeEglKernel<K>) {
      if (kind_ == DeviceKind::egl) {
        const WholeCall call = K::whole(args);
        if (!fits(call)) return on_host(call, [&] { K::tbb(args, *workers_); });
      }
    }
    if constexpr (EglKernel<K>) {
      if (kind_ == DeviceKind::egl) return K::egl(args, *context_);
    }
    K::tbb(args, *workers_);
  }
  bool fits(const WholeCall& call) const;
  void on_host(const WholeCall& call, FunctionRef<void()> run) const;

  Resident make_region_resident(const Region& region) const;
  Resident stage_region(const Region& region) const;
  void send_region(const Region& region) const;
  void fetch_region(const Region& region) const;
  void copy_region(const Region& from, const Region& to) const;

  Device(DeviceKind kind, int threads, Isa isa)
      : kind_(kind), workers_(std::make_shared<Workers>(threads, isa)) {}

  DeviceKind kind_;
  std::shared_ptr<Workers> workers_;
  std::shared_ptr<gl::Context> context_;  ///< of egl only
  KernelClock* clock_ = nullptr;
};

}  // namespace glint
