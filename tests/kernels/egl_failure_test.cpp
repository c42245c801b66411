// SPDX-License-Identifier: Apache-2.0
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "egl.hpp"
#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"

namespace glint {
namespace {

using gl::Api;

/// What the work of a queue throws whose driver has functions that `broken` put in their place.
std::string error_with(const Device& device, const std::function<void(Api&)>& broken,
                       const std::function<void(gl::Queue&)>& work) {
  std::string message = "nothing was thrown";
  device.context().run([&](gl::Queue&) {
    Api api = gl::load_api(gl::open_egl());
    broken(api);
    gl::Queue queue(api, device.context().device(), gl::ProgramCache({}, "test"), false);
    try {
      work(queue);
    } catch (const std::runtime_error& e) {
      message = e.what();
    }
  });
  return message;
}

void send(gl::Queue& queue) {
  const std::vector<float> values(1000);
  queue.upload(std::span<const float>(values));
}

/// The message names the device, what happened, and what to do.
void expect_says(const Device& device, const std::string& message, const std::string& what) {
  const EglDevice& d = device.context().device();
  EXPECT_TRUE(message.starts_with("egl:" + std::to_string(d.number) + " (" + d.renderer + "): "))
      << message;
  EXPECT_NE(message.find(what), std::string::npos) << message;
  EXPECT_NE(message.find("--device tbb"), std::string::npos) << message;
}

TEST(EglFailure, NoMemoryForABufferNamesDeviceAndRemedy) {
  GLINT_NEEDS_EGL(device);
  const auto full = [](Api& api) { api.GetError = [] { return Api::kOutOfMemory; }; };
  expect_says(device, error_with(device, full, send), "no memory for a buffer of ");
}

TEST(EglFailure, AContextThatIsLostNamesDeviceAndRemedy) {
  GLINT_NEEDS_EGL(device);
  const auto lost = [](Api& api) { api.GetError = [] { return Api::kContextLost; }; };
  expect_says(device, error_with(device, lost, send), "the driver lost the context while sending");
}

TEST(EglFailure, MemoryThatCannotBeMappedNamesDeviceAndRemedy) {
  GLINT_NEEDS_EGL(device);
  const auto unmapped = [](Api& api) {
    api.MapBufferRange = [](gl::Enum, std::ptrdiff_t, std::ptrdiff_t, unsigned) -> void* {
      return nullptr;
    };
  };
  expect_says(device, error_with(device, unmapped, send), "gives no access to its memory");
}

TEST(EglFailure, AnErrorThatNobodyExpectsNamesDeviceAndRemedy) {
  GLINT_NEEDS_EGL(device);
  const auto odd = [](Api& api) { api.GetError = [] { return 0x0502u; }; };
  expect_says(device, error_with(device, odd, send), "error 1282 while sending");
}

}  // namespace
}  // namespace glint
