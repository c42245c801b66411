// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>
#include <string>
#include <vector>

#include "egl.hpp"
#include "glint/engine/scenario/scenes.hpp"
#include "glint/engine/scheduler.hpp"
#include "glint/engine/trackers/registry.hpp"
#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"

namespace glint {
namespace {

/// A device that takes no more work once the sink has seen `frame`.
class Failing : public Sink {
 public:
  Failing(const Device& device, std::int64_t frame) : device_(device), frame_(frame) {}
  void take(const ScanResult& result) override {
    frames.push_back(result.scan.frame);
    if (result.scan.frame == frame_) {
      device_.context().run([](gl::Queue& queue) { queue.limit(1); });
    }
  }
  std::vector<std::int64_t> frames;

 private:
  const Device& device_;
  std::int64_t frame_;
};

TEST(EglFailure, InTheMiddleOfARunComesOutAfterAllThatWasTracked) {
  if (test::egl_is_waived()) GTEST_SKIP() << "NOT TESTED ON EGL: GLINT_NO_EGL=1 is set";
  const auto opened = test::egl_device();
  if (!opened) return;
  const Device device = Device::egl(kAnyEglDevice, 1);  // one thread: frame by frame
  SceneSource source(make_scene(CrossingScene{}), 1);
  Scheduler scheduler(device, FramePreparer(FramesConfig{}, device));
  const TrackerEntry& entry = find_tracker("smc-phd");
  scheduler.add(entry.make(entry.config(), device, 1), "smc-phd");
  Failing sink(device, 5);
  scheduler.add(sink);
  try {
    scheduler.run(source);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& e) {
    EXPECT_TRUE(std::string(e.what()).starts_with("egl:")) << e.what();
    EXPECT_NE(std::string(e.what()).find("--device tbb"), std::string::npos) << e.what();
  }
  EXPECT_EQ(sink.frames, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(scheduler.frames(), 6);
}

}  // namespace
}  // namespace glint
