// SPDX-License-Identifier: Apache-2.0
// consumer_frames FILE: frames for README's example, 16 bits, 640x512 pixels: a bright target on
// its way before ripples.
#include <cmath>
#include <cstdint>
#include <fstream>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::ofstream file(argv[1], std::ios::binary);
  constexpr int kWidth = 640, kHeight = 512, kFrames = 12;
  std::vector<std::uint16_t> pixels(std::size_t{kWidth} * kHeight);
  for (int f = 0; f < kFrames; ++f) {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const double dx = x - 300 - 1.2 * f, dy = y - 200 - 0.5 * f;
        const int ripple = (7 * x + 5 * y + 11 * f + x * y) % 23;
        pixels[std::size_t(y) * kWidth + std::size_t(x)] =
            static_cast<std::uint16_t>(100 + ripple + 90 * std::exp(-(dx * dx + dy * dy) / 2));
      }
    }
    file.write(reinterpret_cast<const char*>(pixels.data()),
               static_cast<std::streamsize>(2 * pixels.size()));
  }
  return file ? 0 : 1;
}
