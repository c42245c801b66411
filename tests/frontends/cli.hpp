// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

#include "folder.hpp"
#include "glint/frontends/files/npy.hpp"

namespace glint::test {

struct Result {
  int code = -1;
  std::string out, err;
};

/// Runs the built program with `arguments`, which a shell splits, and `NAME=value` settings of its
/// environment.
inline Result glint(const Folder& folder, const std::string& arguments,
                    const std::string& environment = "") {
  const std::string err = folder / "stderr.txt";
  FILE* pipe =
      popen((environment + " " + GLINT_BINARY + " " + arguments + " 2>" + err).c_str(), "r");
  Result result;
  std::array<char, 4096> buffer;
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe)) {
    result.out.append(buffer.data(), n);
  }
  const int status = pclose(pipe);
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.err = content_of(err);
  return result;
}

/// One line "glint: ..." that holds `part`, and exit code `code`.
inline void expect_error(const Result& result, int code, const std::string& part) {
  EXPECT_EQ(result.code, code) << result.err;
  EXPECT_TRUE(result.err.starts_with("glint: ")) << result.err;
  EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  EXPECT_TRUE(has(result.err, part)) << result.err;
}

/// A cube of flat frames, with `odd` in one pixel of the second frame.
inline std::string cube(const Folder& folder, int width, int height, int frames, float value,
                        float odd) {
  NpyWriter writer(folder / "cube.npy");
  for (int f = 0; f < frames; ++f) {
    Image<float> image(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        image.view()(x, y) = value * static_cast<float>((7 * x + 3 * y + 5 * f) % 11);
      }
    }
    if (f == 1) image.view()(width / 2, height / 2) = odd;
    writer.write(image.view());
  }
  return folder / "cube.npy";
}

}  // namespace glint::test
