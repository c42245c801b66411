// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/embed/embed_ways.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <span>
#include <stdexcept>
#include <utility>

#include "glint/bench/embed/child.hpp"
#include "glint/bench/harness.hpp"
#include "glint/engine/engine.hpp"
#include "glint/engine/run_config.hpp"
#include "glint/engine/settings.hpp"
#include "glint/frontends/capi/glint.h"
#include "glint/frontends/config/toml.hpp"

namespace glint::bench {
namespace {

constexpr const char* kSettings = "[run]\nkeep = 60\n";

/// A way that pushes from this thread: `push` one frame, by number, and `drain`.
template <class Push, class Drain>
Way from_here(Push push, Drain drain) {
  return [push, drain, at = std::int64_t{0}](std::int64_t frames) mutable {
    const double start = on_core();
    for (const std::int64_t end = at + frames; at < end; ++at) push(at);
    drain();
    return on_core() - start;
  };
}

std::vector<ConfigSection> settings() {
  std::vector<ConfigSection> sections = all_sections();
  parse_toml(kSettings, "settings", sections);
  apply_set(std::string("run.tracker=") + kEmbedTracker, sections);
  return sections;
}

void check(glint_status status) {
  if (status != GLINT_OK) throw std::runtime_error(glint_last_error());
}

std::shared_ptr<glint_engine> engine_in_c() {
  glint_options options = GLINT_OPTIONS_INIT;
  options.tracker = kEmbedTracker, options.config = kSettings;
  glint_engine* engine = nullptr;
  check(glint_create(&options, &engine));
  return {engine, glint_destroy};
}

// Plays the images forth and back, as MemoryScene does; a line in says how many frames, a line out
// how long its thread was on a core for them.
constexpr const char* kPython = R"(
import sys
import time
import numpy
import glint

path, height, width, tracker, config = sys.argv[1:]
images = numpy.fromfile(path, numpy.uint16).reshape(-1, int(height), int(width))
period = 2 * len(images) - 2
engine = glint.Engine(tracker, config=config)
at = 0
print('ready', flush=True)
for line in sys.stdin:
    start = time.thread_time()
    for at in range(at, at + int(line)):
        phase = at % period
        engine.push(images[min(phase, period - phase)], at)
        while engine.poll() is not None:
            pass
    at += 1
    engine.drain()
    print(time.thread_time() - start, flush=True)
)";

}  // namespace

Way pushed_in_cpp(const EmbedScene& scene) {
  const auto engine = std::make_shared<Engine>(pushed_frames_scheduler(settings()));
  const auto push = [scene, engine](std::int64_t at) {
    const auto view = scene->frame(at).view();
    SourceFrame frame;
    frame.pixels = {view.data, view.width, view.height, 1, view.pitch};
    frame.owner = scene;
    frame.time = static_cast<double>(at);
    engine->push(std::move(frame));
    while (engine->poll()) {
    }
  };
  return from_here(push, [engine] { engine->drain(); });
}

Way pushed_in_c(const EmbedScene& scene) {
  const auto engine = engine_in_c();
  const auto push = [scene, engine](std::int64_t at) {
    std::array<glint_track, 1000> tracks;
    glint_result result = GLINT_RESULT_INIT;
    const auto view = scene->frame(at).view();
    glint_frame frame = GLINT_FRAME_INIT;
    frame.data = view.data, frame.pixel = GLINT_GRAY16;
    frame.width = view.width, frame.height = view.height;
    frame.row_bytes = view.pitch * std::ptrdiff_t{sizeof(std::uint16_t)};
    frame.time = static_cast<double>(at);
    frame.release = [](void*) {};
    check(glint_push(engine.get(), &frame));
    while (glint_poll(engine.get(), &result, tracks.data(), tracks.size()) == GLINT_OK) {
    }
  };
  return from_here(push, [engine] { check(glint_drain(engine.get())); });
}

std::vector<std::uint16_t> packed(const MemoryScene& scene, std::int64_t frame) {
  const auto view = scene.frame(frame).view();
  std::vector<std::uint16_t> pixels;
  for (int y = 0; y < view.height; ++y) {
    pixels.insert(pixels.end(), view.row(y), view.row(y) + view.width);
  }
  return pixels;
}

ImageFile::ImageFile(const MemoryScene& scene)
    : path_(std::filesystem::temp_directory_path() / fmt::format("glint_embed_{}.raw", getpid())) {
  std::ofstream file(path_, std::ios::binary);
  for (int i = 0; i < kEmbedImages; ++i) {
    const auto pixels = packed(scene, i);
    const auto bytes = std::as_bytes(std::span(pixels));
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }
  if (!file.flush()) throw std::runtime_error(path_.string() + ": cannot be written");
}

ImageFile::~ImageFile() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

Way pushed_in_python(const ImageFile& images) {
  const char* path = std::getenv("PYTHONPATH");
  // In the build folder the module lies beside the program's folder.
  const std::string module = (program().parent_path().parent_path() / "python").string();
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    const auto child = std::make_shared<Child>(
        std::vector<std::string>{
            "env", "PYTHONPATH=" + module + (path != nullptr ? std::string(":") + path : ""),
            python, "-c", kPython, images.path(), std::to_string(kEmbedHeight),
            std::to_string(kEmbedWidth), kEmbedTracker, kSettings},
        Child::Output::read);
    if (child->line() != "ready") continue;
    return [child](std::int64_t frames) {
      const std::string line = std::to_string(frames) + "\n";
      child->write(std::as_bytes(std::span(line)));
      const auto own_time = child->line();
      if (!own_time) throw std::runtime_error("Python ended before its frames did");
      return std::stod(*own_time);
    };
  }
  fmt::print(stderr, "bench: Python left out: no python3 that imports glint and numpy\n");
  return nullptr;
}

std::filesystem::path program() { return std::filesystem::read_symlink("/proc/self/exe"); }

}  // namespace glint::bench
