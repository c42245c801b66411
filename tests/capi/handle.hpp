// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <glint.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "clip.hpp"

namespace glint::test {

struct Destroy {
  void operator()(glint_engine* engine) const { glint_destroy(engine); }
};
using Handle = std::unique_ptr<glint_engine, Destroy>;

inline Handle create(const char* tracker, const char* config = nullptr) {
  glint_options options = GLINT_OPTIONS_INIT;
  options.tracker = tracker, options.config = config;
  glint_engine* engine = nullptr;
  EXPECT_EQ(glint_create(&options, &engine), GLINT_OK) << glint_last_error();
  return Handle(engine);
}

inline glint_frame frame_of(const std::vector<std::uint16_t>& pixels, double time) {
  glint_frame frame = GLINT_FRAME_INIT;
  frame.data = pixels.data(), frame.pixel = GLINT_GRAY16;
  frame.width = kWidth, frame.height = kHeight, frame.time = time;
  return frame;
}

inline bool said(const char* part) {
  return std::string(glint_last_error()).find(part) != std::string::npos;
}

}  // namespace glint::test
