// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>

#include "glint/bench/data.hpp"
#include "glint/bench/kernels/suites.hpp"
#include "glint/bench/limits.hpp"
#include "glint/engine/frames/frame_preparer.hpp"

namespace glint::bench {
namespace {

constexpr std::uint32_t kFrames = 4;  // taken in turns, so that the noise changes

// A sensor's stream into a preparer that has filled its window.
class Stream {
 public:
  Stream(FrameSize size, const Device& device) : preparer_(FramesConfig{}, device) {
    for (std::uint32_t i = 0; i < kFrames; ++i) {
      frames_.push_back(sensor_frame(size.width, size.height, i));
    }
    while (count_ < FramesConfig{}.background_frames) step();
  }
  // From one sample of the background's median to the next: the dear frame and the cheap ones.
  static constexpr int kPeriod = 6;
  void period() {
    for (int i = 0; i < kPeriod; ++i) step();
  }

 private:
  void step() {
    const auto& view = std::as_const(frames_[static_cast<std::size_t>(count_ % kFrames)]).view();
    const RawPixels raw{view.data, view.width, view.height, 1, view.pitch};
    preparer_.prepare(raw, count_, static_cast<double>(count_));
    ++count_;
  }

  std::vector<Image<std::uint16_t>> frames_;
  FramePreparer preparer_;
  std::int64_t count_ = 0;
};

Case stream(const std::string& name, FrameSize size, const Device& device, int threads) {
  const auto s = std::make_shared<Stream>(size, device);
  return {name, threads, Stream::kPeriod * size.pixels(), [s] { s->period(); }};
}

std::string text(FrameSize size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace

Suite prepare_frames(FrameSize size) {
  Suite suite("prepare_frame: whole FramePreparer, uint16 input", "px");
  const FrameSize clip{320, 256};
  for (const FrameSize s : {size, clip}) {
    for (const int threads : {1, 2}) {
      suite.add(stream(text(s) + " x" + std::to_string(threads), s, Device::tbb(threads), threads));
    }
  }
  suite.add(stream("serial", {96, 80}, Device::serial(), 1));
  const auto raw = std::make_shared<Image<std::uint16_t>>(sensor_frame(size.width, size.height));
  const auto grey = std::make_shared<Image<float>>(size.width, size.height);
  suite.add_threads("limit: u16 to float", size.pixels(), [raw, grey](const Device& device) {
    stream_widen(device.workers(), memory_of(std::as_const(*raw).view()), memory_of(grey->view()));
  });
  suite.ratio_threads(text(size) + " of a u16-to-float pass", text(size), "limit: u16 to float", {},
                      {});
  suite.ratio_of_threads(text(size) + " of the serial reference", text(size), "serial", {}, {});
  suite.ratio_of_threads(text(clip) + " of the serial reference", text(clip), "serial", {}, {});
  suite.scaling(text(size), {1.6, 1.6});
  suite.growth(text(clip) + " to " + text(size) + ", dearest / cheapest pixel, x1",
               {text(size) + " x1", text(clip) + " x1"}, {{}, 1.5, true});
  return suite;
}

}  // namespace glint::bench
