// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/auto_device.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <exception>
#include <limits>
#include <stdexcept>
#include <utility>

#include "glint/kernels/core/egl_hardware.hpp"
#include "glint/kernels/core/particles.hpp"
#include "glint/kernels/particle_likelihood/particle_likelihood.hpp"
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"
#include "glint/kernels/propagate/propagate.hpp"

namespace glint {
namespace {

constexpr int kSide = 1024;  // [px]
constexpr std::size_t kParticles = 200000;
constexpr int kTimes = 3;

/// A scan's dearest kernels on made-up data: a frame of 1 M pixels and a cloud of particles.
class Calibration {
 public:
  Calibration() : frame_(kSide, kSide), map_(kSide, kSide), log_ratio_(kParticles) {
    cloud_.resize(kParticles);
    for (std::size_t i = 0; i < kParticles; ++i) {
      const auto at = static_cast<std::uint32_t>(i) * 2654435761u;
      cloud_.x[i] = static_cast<float>(at % kSide);
      cloud_.y[i] = static_cast<float>((at >> 16) % kSide);
      cloud_.intensity[i] = 5;
    }
  }
  void run(const Device& device) {
    const PointSpread spread = PointSpread::of(.7);
    PixelLikelihood::Args pixels;
    pixels.frame = std::as_const(frame_).view();
    pixels.spread = spread;
    pixels.intensity = 5;
    pixels.map = map_.view();
    device.run<PixelLikelihood>(pixels);
    static constexpr MotionMode kVelocity{};
    Particles& p = cloud_;
    Propagate::Args moves{p.x, p.y, p.vx, p.vy, p.intensity, {}, {}, {}, {&kVelocity, 1}, {}};
    moves.intensity_high = 10;
    device.run<Propagate>(moves);
    device.run<ParticleLikelihood>(
        {std::as_const(frame_).view(), spread, p.x, p.y, p.intensity, log_ratio_});
  }

 private:
  Image<float> frame_, map_;
  Particles cloud_;
  AlignedVector<float> log_ratio_;
};

/// The least of a few, after one that compiles shaders and touches memory.
double calibrate(const Device& device) {
  Calibration work;
  work.run(device);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kTimes; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work.run(device);
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
