// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/auto_device.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <exception>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "glint/kernels/core/egl_hardware.hpp"
#include "glint/kernels/core/resident_memory.hpp"
#include "glint/kernels/particle_likelihood/particle_likelihood.hpp"
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"
#include "glint/kernels/propagate/propagate.hpp"

namespace glint {
namespace {

constexpr int kSide = 1024;  // [px]
constexpr std::size_t kParticles = 200000;
constexpr int kTimes = 3;

/// A scan's dearest kernels on made-up data, a frame of 1 M pixels and a cloud of particles: as in
/// a tracker the frame goes up anew, the rest stays on the device, and the result comes back.
class Calibration {
 public:
  explicit Calibration(const Device& device)
      : device_(device), frame_(kSide, kSide), map_(kSide, kSide, device), log_ratio_(device) {
    const auto kept = [&](float first, std::uint32_t factor, std::uint32_t values) {
      ResidentArray<float> array(device);
      array.resize(kParticles);
      std::uint32_t at = 0;
      for (float& value : array.values()) {
        value = first + static_cast<float>((at++ * factor >> 8) % values);
      }
      array.send();
      return array;
    };
    for (const std::uint32_t factor : {2654435761u, 2246822519u}) {
      arrays_.push_back(kept(0, factor, kSide));  // x, y
    }
    for (int i = 0; i < 2; ++i) arrays_.push_back(kept(0, 1, 1));  // vx, vy
    arrays_.push_back(kept(5, 1, 1));                              // intensity
    log_ratio_.resize(kParticles);
  }
  void run() {
    const FrameView frame = std::as_const(frame_).view();
    const Resident sent = device_.stage(frame);
    const PointSpread spread = PointSpread::of(.7);
    PixelLikelihood::Args pixels;
    pixels.frame = frame;
    pixels.spread = spread;
    pixels.intensity = 5;
    pixels.map = map_.view();
    device_.run<PixelLikelihood>(pixels);
    static constexpr MotionMode kVelocity{};
    const auto array = [&](std::size_t i) { return arrays_[i].values(); };
    Propagate::Args moves{array(0), array(1), array(2), array(3),        array(4),
                          {},       {},       {},       {&kVelocity, 1}, {}};
    moves.intensity_high = 10;
    device_.run<Propagate>(moves);
    device_.run<ParticleLikelihood>(
        {frame, spread, array(0), array(1), array(4), log_ratio_.values()});
    log_ratio_.fetch();
  }

 private:
  Device device_;
  Image<float> frame_;
  ResidentImage<float> map_;
  std::vector<ResidentArray<float>> arrays_;
  ResidentArray<float> log_ratio_;
};

/// The least of a few, after one that compiles shaders and touches memory.
double calibrate(const Device& device) {
  Calibration work(device);
  work.run();
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kTimes; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work.run();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    least = std::min(least, taken.count());
  }
  return least;
}

HardwareFound open_hardware(int threads) {
  try {
    if (!lists_hardware()) return {std::nullopt, "there is no GPU that EGL knows of"};
  } catch (const std::runtime_error& e) {
    return {std::nullopt, std::string("there is no GPU: ") + e.what()};
  }
  Device device = Device::egl(kAnyEglDevice, threads);
  if (is_software(device)) return {std::nullopt, "there is no GPU that EGL can open"};
  return {std::move(device), ""};
}

std::string milliseconds(double seconds) {
  std::string text = std::to_string(seconds * 1e3);
  return text.substr(0, text.find('.') + 2) + " ms";
}

AutoChoice contest(const Device& gpu, const Device& tbb, const AutoProbe& probe) {
  const double on_gpu = probe.seconds(gpu), on_tbb = probe.seconds(tbb);
  const bool wins = on_gpu < kAutoShare * on_tbb;
  const std::string times = gpu.description() + " takes " + milliseconds(on_gpu) +
                            " for the calibration's kernels, tbb " + milliseconds(on_tbb);
  return {wins ? gpu : tbb, times + (wins ? "" : ": not enough to win")};
}

}  // namespace

AutoProbe this_machine() { return {open_hardware, calibrate}; }

AutoChoice choose_device(int threads, const AutoProbe& probe) {
  const Device tbb = Device::tbb(threads);
  try {
    const HardwareFound gpu = probe.hardware(threads);
    if (!gpu.device) return {tbb, gpu.none};
    return contest(*gpu.device, tbb, probe);
  } catch (const std::exception& e) {
    return {tbb, std::string("the GPU does not work, so tbb it is: ") + e.what(), true};
  }
}

}  // namespace glint
