// SPDX-License-Identifier: Apache-2.0
#include <glint.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "clip.hpp"
#include "handle.hpp"

namespace glint::test {
namespace {

struct Free {
  void operator()(void* data) const { glint_free(data); }
};

std::string checkpoint_of(glint_engine* engine) {
  void* data = nullptr;
  std::size_t size = 0;
  EXPECT_EQ(glint_checkpoint(engine, &data, &size), GLINT_OK) << glint_last_error();
  const std::unique_ptr<void, Free> owned(data);
  return {static_cast<const char*>(data), size};
}

glint_status restored(const std::string& bytes, const char* tracker, const char* config,
                      Handle& handle) {
  glint_options options = GLINT_OPTIONS_INIT;
  options.tracker = tracker, options.config = config;
  glint_engine* engine = nullptr;
  const glint_status status = glint_restore(&options, bytes.data(), bytes.size(), &engine);
  EXPECT_EQ(status == GLINT_OK, engine != nullptr);
  handle.reset(engine);
  return status;
}

/// The rows as they lie in memory.
std::string revised_bytes(glint_engine* engine) {
  EXPECT_EQ(glint_finish(engine), GLINT_OK) << glint_last_error();
  std::vector<glint_track> rows(1000);
  std::size_t count = rows.size();
  EXPECT_EQ(glint_revised(engine, rows.data(), sizeof(glint_track), &count), GLINT_OK);
  return {reinterpret_cast<const char*>(rows.data()), count * sizeof(glint_track)};
}

void push_frames(glint_engine* engine, int first, int last) {
  for (int f = first; f < last; ++f) {
    const auto pixels = picture(f);
    const glint_frame frame = frame_of(pixels, f);
    ASSERT_EQ(glint_push(engine, &frame), GLINT_OK) << glint_last_error();
  }
}

// A result that was too large for the caller's array comes after the checkpoint, like the others.
TEST(CApiCheckpoint, ARestoredEngineGoesOnWithTheSameTracks) {
  const Handle whole = create("smc-phd"), first = create("smc-phd");
  push_frames(whole.get(), 0, kFrames), push_frames(first.get(), 0, 15);
  ASSERT_EQ(glint_drain(first.get()), GLINT_OK);
  glint_result result = GLINT_RESULT_INIT;
  std::array<glint_track, 50> tracks;
  while (glint_poll(first.get(), &result, tracks.data(), 0) == GLINT_OK) {
  }
  const std::int64_t held = result.frame;
  EXPECT_GT(result.tracks, 0u);
  Handle second;
  ASSERT_EQ(restored(checkpoint_of(first.get()), "smc-phd", "[run]\nthreads = 1\n", second),
            GLINT_OK)
      << glint_last_error();
  ASSERT_EQ(glint_poll(second.get(), &result, tracks.data(), tracks.size()), GLINT_OK);
  EXPECT_EQ(result.frame, held);
  push_frames(second.get(), 15, kFrames);
  const std::string expected = revised_bytes(whole.get());
  EXPECT_GT(expected.size(), 10 * sizeof(glint_track));
  EXPECT_TRUE(revised_bytes(second.get()) == expected);
  std::int64_t pushed = 0;
  EXPECT_EQ(glint_counts(second.get(), &pushed, nullptr), GLINT_OK);
  EXPECT_EQ(pushed, kFrames);
}

TEST(CApiCheckpoint, IsRefusedWithAWordOnWhy) {
  const Handle engine = create("smc-phd");
  push_frames(engine.get(), 0, 3);
  const std::string bytes = checkpoint_of(engine.get());
  Handle none;
  EXPECT_EQ(restored(bytes, "mm-phd", nullptr, none), GLINT_BAD_CHECKPOINT);
  EXPECT_TRUE(said("trackers was smc-phd, and is mm-phd")) << glint_last_error();
  EXPECT_EQ(restored(bytes, "smc-phd", "[run]\nseed = 2\n", none), GLINT_BAD_CHECKPOINT);
  EXPECT_TRUE(said("\"seed = 1\" then and \"seed = 2\" now, in [run]")) << glint_last_error();
  EXPECT_EQ(restored(bytes, "smc-phd", "[run]\ndevice = \"serial\"\n", none), GLINT_BAD_CHECKPOINT);
  EXPECT_TRUE(said("device was tbb, and is serial")) << glint_last_error();
  EXPECT_EQ(restored(bytes.substr(0, 100), "smc-phd", nullptr, none), GLINT_BAD_CHECKPOINT);
  EXPECT_TRUE(said("checksum")) << glint_last_error();
  EXPECT_EQ(restored("", "smc-phd", nullptr, none), GLINT_BAD_CHECKPOINT);
  EXPECT_EQ(glint_restore(nullptr, bytes.data(), bytes.size(), nullptr), GLINT_BAD_ARGUMENT);
  void* data = nullptr;
  std::size_t size = 0;
  EXPECT_EQ(glint_checkpoint(engine.get(), nullptr, &size), GLINT_BAD_ARGUMENT);
  ASSERT_EQ(glint_finish(engine.get()), GLINT_OK);
  EXPECT_EQ(glint_checkpoint(engine.get(), &data, &size), GLINT_BAD_STATE);
  EXPECT_EQ(data, nullptr);
  glint_free(nullptr);
}

// The example, a process for each half.
TEST(CApiCheckpoint, AnotherProcessGoesOn) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("glint_resume_" + std::to_string(getpid()));
  fs::create_directory(folder);
  const auto tracks = [&](int first, int last, const std::string& state) {
    const std::string raw = (folder / "raw").string(), out = (folder / "out").string();
    std::ofstream file(raw, std::ios::binary);
    for (int f = first; f < last; ++f) {
      const auto pixels = picture(f);
      file.write(reinterpret_cast<const char*>(pixels.data()),
                 static_cast<std::streamsize>(2 * pixels.size()));
    }
    file.close();
    const std::string command = std::string(GLINT_RESUME_RAW) + " 48 32 h-pmht " +
                                (folder / state).string() + " < " + raw + " > " + out;
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    std::ifstream printed(out);
    return std::string(std::istreambuf_iterator<char>(printed), {});
  };
  const std::string whole = tracks(0, kFrames, "whole");
  EXPECT_GT(whole.size(), 500u);
  const std::string before = tracks(0, 14, "parts");
  EXPECT_EQ(before + tracks(14, kFrames, "parts"), whole);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace glint::test
