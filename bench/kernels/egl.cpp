// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>
#include <memory>
#include <string>

#include "glint/bench/data.hpp"
#include "glint/bench/engine_run.hpp"
#include "glint/bench/kernels/suites.hpp"
#include "glint/kernels/core/device_traffic.hpp"
#include "glint/kernels/core/egl_hardware.hpp"
#include "glint/kernels/particle_likelihood/particle_likelihood.hpp"
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"
#include "glint/kernels/propagate/propagate.hpp"

namespace glint::bench {
namespace {

constexpr int kTargets = 50, kTimes = 3;
constexpr double kSigma = 0.7;
constexpr std::size_t kParticles = 10000000, kFew = 100000;
constexpr std::size_t kCopy = std::size_t{256} << 20;  // [bytes], if a buffer may be as large

/// A kernel's work, and the bytes that it cannot do without: each input and output once.
struct Work {
  std::string name;
  double bytes;
  std::function<void(const Device&)> run;
};

Work pixels(FrameSize size) {
  struct Data {
    Image<float> frame, map;
  };
  const auto data = std::make_shared<Data>(
      Data{noise_frame(size.width, size.height), Image<float>(size.width, size.height)});
  return {"pixel_likelihood", 8 * size.pixels(), [data](const Device& device) {
            PixelLikelihood::Args a;
            a.frame = std::as_const(data->frame).view();
            a.spread = PointSpread::of(kSigma);
            a.intensity = 5;
            a.map = data->map.view();
            device.run<PixelLikelihood>(a);
          }};
}

Work particles(FrameSize size, std::size_t n) {
  struct Data {
    Image<float> frame;
    Particles cloud;
    AlignedVector<float> log_ratio;
  };
  const auto data = std::make_shared<Data>(Data{noise_frame(size.width, size.height),
                                                clouds(n, kTargets, size.width, size.height),
                                                AlignedVector<float>(n)});
  return {"particle_likelihood", 16.0 * static_cast<double>(n), [data](const Device& device) {
            const Particles& p = data->cloud;
            device.run<ParticleLikelihood>({data->frame.view(), PointSpread::of(kSigma), p.x, p.y,
                                            p.intensity, data->log_ratio});
          }};
}

Work moves(FrameSize size, std::size_t n) {
  static constexpr MotionMode kVelocity{Motion::constant_velocity, 0, 1e-3f};
  const auto cloud = std::make_shared<Particles>(clouds(n, kTargets, size.width, size.height));
  return {"propagate", 40.0 * static_cast<double>(n), [cloud](const Device& device) {
            Particles& p = *cloud;
            Propagate::Args a{p.x, p.y, p.vx, p.vy, p.intensity, {}, {}, {}, {&kVelocity, 1}, {}};
            a.intensity_noise = 1e-2f;
            a.intensity_high = 100;
            a.seed = 1;
            device.run<Propagate>(a);
          }};
}

/// The call with the shortest time in shaders, after one that compiles them.
DeviceTraffic best_call(const Work& work, const Device& egl) {
  work.run(egl);
  DeviceTraffic best;
  for (int i = 0; i < kTimes; ++i) {
    time_traffic(egl, true);
    work.run(egl);
    const DeviceTraffic one = traffic_of(egl);
    if (i == 0 || one.compute < best.compute) best = one;
  }
  time_traffic(egl, false);
  return best;
}

double best_seconds(const Work& work, const Device& device) {
  work.run(device);
  double best = 0;
  for (int i = 0; i < kTimes; ++i) {
    KernelClock clock;
    work.run(device.timed_by(clock));
    const double one = clock.seconds().begin()->second;
    best = i == 0 ? one : std::min(best, one);
  }
  return best;
}

Timing rate(const std::string& name, int threads, double seconds, double bytes) {
  return {name, threads, seconds, bytes / seconds, kTimes, 0};
}

}  // namespace

Result egl_bandwidth(const Device& egl, FrameSize size, bool quick) {
  const std::size_t n = quick ? kFew : kParticles;
  Result result{"kernels beside the copy bandwidth of " + egl.description() + ", " +
                    std::to_string(size.width) + "x" + std::to_string(size.height) + ", " +
                    std::to_string(n) + " particles",
                "B",
                {},
                {}};
  const bool goals = !is_software(egl) && !quick && size == kReferenceSize;
  const Device tbb = Device::tbb();
  const std::size_t copied = std::min(kCopy, max_buffer_bytes(egl));
  const double seconds = copy_seconds(egl, copied, kTimes);
  const Timing copying =
      rate("copy on the device", 1, seconds, 2 * static_cast<double>(copied));  // read and written
  const double copy = copying.rate;
  result.timings.push_back(copying);
  for (const Work& work : {pixels(size), particles(size, n), moves(size, n)}) {
    const DeviceTraffic on_egl = best_call(work, egl);
    const double on_tbb = best_seconds(work, tbb);
    const double all = on_egl.upload + on_egl.compute + on_egl.read_back;
    result.timings.push_back(rate(work.name + ": shaders", 1, on_egl.compute, work.bytes));
    result.timings.push_back(rate(work.name + ": with both ways", 1, all, work.bytes));
    result.timings.push_back(
        rate(work.name + ": tbb", tbb.workers().threads(), on_tbb, work.bytes));
    const bool gathers = work.name == ParticleLikelihood::name;
    result.figures.push_back({work.name + ": shaders of the copy",
                              work.bytes / on_egl.compute / copy,
                              goals && !gathers ? Target{{}, .7} : Target{}});
    result.figures.push_back({work.name + ": shaders of tbb", on_tbb / on_egl.compute,
                              goals && gathers ? Target{{}, 10} : Target{}});
    result.figures.push_back({work.name + ": with both ways of tbb", on_tbb / all, {}});
  }
  return result;
}

}  // namespace glint::bench
