// SPDX-License-Identifier: Apache-2.0
// The example of examples/, and what the shared library shows.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "clip.hpp"

namespace glint::test {
namespace {

std::string output_of(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  std::string text;
  std::array<char, 4096> buffer;
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe)) {
    text.append(buffer.data(), n);
  }
  EXPECT_EQ(pclose(pipe), 0) << command;
  return text;
}

TEST(Examples, PrintTheTracksOfTheEngine) {
  const std::string raw =
      std::filesystem::temp_directory_path() / ("glint_capi_" + std::to_string(getpid()) + ".raw");
  {
    std::ofstream file(raw, std::ios::binary);
    for (int f = 0; f < kFrames; ++f) {
      const auto pixels = picture(f);
      file.write(reinterpret_cast<const char*>(pixels.data()),
                 static_cast<std::streamsize>(2 * pixels.size()));
    }
  }
  std::string expected;
  for (const EngineResult& result : engine_results("smc-phd")) {
    for (const Track& p : result.tracks) {
      if (p.status != TrackStatus::confirmed) continue;
      std::array<char, 128> line;
      std::snprintf(line.data(), line.size(), "%lld %lld %.9g %.9g\n",
                    static_cast<long long>(p.frame), static_cast<long long>(p.track_id), p.x, p.y);
      expected += line.data();
    }
  }
  EXPECT_FALSE(expected.empty());
  for (const char* example : {GLINT_TRACK_RAW, GLINT_TRACK_RAW_CPP}) {
    EXPECT_EQ(output_of(std::string(example) + " 48 32 smc-phd < " + raw), expected) << example;
  }
  std::filesystem::remove(raw);
}

TEST(CApiExample, TheLibraryShowsTheInterfaceAlone) {
  std::istringstream symbols(
      output_of(std::string(GLINT_NM) + " -D --defined-only --format=posix " + GLINT_C_LIBRARY));
  int shown = 0;
  for (std::string line; std::getline(symbols, line); ++shown) {
    EXPECT_TRUE(line.starts_with("glint_")) << line;
  }
  EXPECT_EQ(shown, 19);
}

}  // namespace
}  // namespace glint::test
