// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"

#include <memory>

#include "glint/bench/baselines/opencv.hpp"
#include "glint/bench/baselines/plain.hpp"
#include "glint/bench/data.hpp"
#include "glint/bench/kernels/suites.hpp"
#include "glint/bench/limits.hpp"

namespace glint::bench {
namespace {

constexpr Target kPixelScaling{1.6, 1.6};

// A frame of noise and what a pass over it writes.
struct Scene {
  explicit Scene(FrameSize size)
      : frame(noise_frame(size.width, size.height)), map(size.width, size.height) {}

  PixelLikelihood::Args args() {
    PixelLikelihood::Args a;
    a.frame = std::as_const(frame).view();
    a.spread = PointSpread::of(0.7);
    a.intensity = 5;
    a.threshold = 5;
    a.map = map.view();
    a.hits = &hits;
    return a;
  }

  Image<float> frame, map;
  std::vector<Hit> hits;
};

std::function<void(const Device&)> kernel(const std::shared_ptr<Scene>& scene) {
  return [scene](const Device& device) { device.run<PixelLikelihood>(scene->args()); };
}

// The scalar double reference, on a frame small enough to wait for.
Case reference(const char* name) {
  const FrameSize size{128, 128};
  const auto scene = std::make_shared<Scene>(size);
  return {name, 1, size.pixels(), [scene] { PixelLikelihood::serial(scene->args()); }};
}

Case naive() {
  const FrameSize size{256, 256};
  const auto scene = std::make_shared<Scene>(size);
  return {"naive", 1, size.pixels(), [scene] { naive_pixel_likelihood(scene->args()); }};
}

void add_opencv(Suite& suite, const std::shared_ptr<Scene>& scene, double pixels) {
  if (!OpenCvPixelLikelihood::available()) return;
  const OpenCvPixelLikelihood opencv(scene->args());
  suite.add({"OpenCV pipeline", 1, pixels, [opencv, scene] { opencv.run(); }});
  suite.add({"OpenCV sepFilter2D", 1, pixels, [opencv, scene] { opencv.correlate(); }});
}

}  // namespace

Suite pixel_likelihood_float(FrameSize size) {
  Suite suite("pixel_likelihood: float, 5x5, map and hits", "px");
  const auto scene = std::make_shared<Scene>(size);
  suite.add_threads("glint", size.pixels(), kernel(scene));
  suite.add_threads("limit: copy", size.pixels(), [scene](const Device& device) {
    stream_copy(device.workers(), memory_of(FrameView(scene->frame)), memory_of(scene->map.view()));
  });
  add_opencv(suite, scene, size.pixels());
  suite.add(naive());
  suite.add(reference("serial"));
  suite.ratio_threads("of a streaming copy", "glint", "limit: copy", {.65, .80}, {.89, .95});
  suite.ratio_of_threads("of the OpenCV pipeline", "glint", "OpenCV pipeline", {5, 5}, {10, 10});
  suite.ratio_of_threads("of sepFilter2D alone", "glint", "OpenCV sepFilter2D", {2.4, 2.4},
                         {4.4, 4.4});
  suite.ratio("of 25 checked taps, x1", "glint x1", "naive", {79, 79});
  suite.ratio_of_threads("of the serial reference", "glint", "serial", {}, {});
  suite.scaling("glint", kPixelScaling);
  return suite;
}

Suite pixel_likelihood_u16(FrameSize size) {
  Suite suite("pixel_likelihood: uint16, 5x5, map and hits", "px");
  const auto scene = std::make_shared<Scene>(size);
  const auto raw = std::make_shared<Image<std::uint16_t>>(sensor_frame(size.width, size.height));
  suite.add_threads("glint", size.pixels(), [scene, raw](const Device& device) {
    auto args = scene->args();
    args.frame = std::as_const(*raw).view();
    args.offset = kSensorOffset;
    args.scale = 1 / kSensorScale;
    device.run<PixelLikelihood>(args);
  });
  suite.add_threads("limit: u16 to float", size.pixels(), [scene, raw](const Device& device) {
    stream_widen(device.workers(), memory_of(std::as_const(*raw).view()),
                 memory_of(scene->map.view()));
  });
  suite.ratio_threads("of a u16-to-float pass", "glint", "limit: u16 to float", {.57, .85},
                      {.94, .94});
  suite.scaling("glint", kPixelScaling);
  return suite;
}

Suite pixel_likelihood_hits(FrameSize size) {
  Suite suite("pixel_likelihood: float, 5x5, hits only", "px");
  const auto scene = std::make_shared<Scene>(size);
  suite.add_threads("glint", size.pixels(), [scene](const Device& device) {
    auto args = scene->args();
    args.map = {};
    device.run<PixelLikelihood>(args);
  });
  suite.add_threads("limit: read", size.pixels(), [scene](const Device& device) {
    read(device.workers(), memory_of(FrameView(scene->frame)));
  });
  suite.ratio_threads("of reading", "glint", "limit: read", {.50, .50}, {.80, .90});
  suite.scaling("glint", kPixelScaling);
  return suite;
}

Suite pixel_likelihood_growth() {
  Suite suite("pixel_likelihood: growth with the frame", "px");
  std::vector<std::string> names;
  for (const int side : {256, 512, 1024, 2048, 4096}) {
    const FrameSize size{side, side};
    const auto scene = std::make_shared<Scene>(size);
    names.push_back(std::to_string(side) + " px a side");
    suite.add({names.back(), 1, size.pixels(),
               [run = kernel(scene), device = Device::tbb(1)] { run(device); }});
  }
  suite.growth("dearest / cheapest pixel", names, {1.35, 1.5, true});
  return suite;
}

}  // namespace glint::bench
