// SPDX-License-Identifier: Apache-2.0
// Tracks 16-bit grey frames from standard input and prints confirmed tracks as they are known:
//
//     c++ -std=c++20 track_raw.cpp $(pkg-config --cflags --libs glint) -o track_raw
//     camera | ./track_raw 640 512 mm-phd
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <glint/glint.hpp>
#include <vector>

namespace {

void print(const glint::EngineResult& result) {
  for (const glint::Track& track : result.tracks) {
    if (track.status != glint::TrackStatus::confirmed) continue;
    std::printf("%lld %lld %.9g %.9g\n", static_cast<long long>(track.frame),
                static_cast<long long>(track.track_id), track.x, track.y);
  }
  std::fflush(stdout);
}

void run(int width, int height, const char* tracker) {
  // Late corrections are not asked for: the log holds the last 1000 frames, however many come.
  glint::Engine engine(tracker, {{"run.keep", 1000}});
  std::vector<std::uint16_t> pixels(static_cast<std::size_t>(width) *
                                    static_cast<std::size_t>(height));
  double time = 0;  // [s]
  while (std::fread(pixels.data(), sizeof(pixels[0]), pixels.size(), stdin) == pixels.size()) {
    engine.push({pixels.data(), width, height}, time++);
    while (const auto result = engine.poll()) print(*result);
  }
  engine.finish();
  for (const auto& result : engine.results()) print(result);
}

}  // namespace

int main(int argc, char** argv) {
  const int width = argc == 4 ? std::atoi(argv[1]) : 0, height = argc == 4 ? std::atoi(argv[2]) : 0;
  if (width <= 0 || height <= 0) {
    std::fprintf(stderr, "usage: %s WIDTH HEIGHT TRACKER < frames\n", argv[0]);
    return 2;
  }
  try {
    run(width, height, argv[3]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
