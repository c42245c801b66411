// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/cli/bench_embed.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "glint/bench/engine_run.hpp"
#include "glint/bench/together.hpp"
#include "glint/engine/engine.hpp"
#include "glint/frontends/capi/glint.h"
#include "glint/frontends/cli/child.hpp"
#include "glint/frontends/config/run_config.hpp"
#include "glint/frontends/config/settings.hpp"
#include "glint/frontends/config/toml.hpp"

namespace glint::cli {
namespace {

namespace fs = std::filesystem;
using bench::Case;
using bench::MemoryScene;

constexpr int kWidth = 640, kHeight = 512, kImages = 64;
constexpr const char* kTracker = "mm-phd";
constexpr const char* kSettings = "[run]\nkeep = 60\n";
constexpr int kThreads = 2;
constexpr double kMostOverPlain = 1.02;
constexpr const char* kPlain = "plain pipeline";
constexpr const char* kOverPlain = ", time of a frame over the plain one's";

using Scene = std::shared_ptr<const MemoryScene>;

/// A way into the engine, warm: each call pushes that many more frames and takes their tracks.
using Way = std::function<void(std::int64_t frames)>;

std::vector<ConfigSection> settings() {
  std::vector<ConfigSection> sections = all_sections();
  parse_toml(kSettings, "settings", sections);
  apply_set(std::string("run.tracker=") + kTracker, sections);
  return sections;
}

Way pushed_in_cpp(const Scene& scene) {
  const auto engine = std::make_shared<Engine>(pushed_frames_scheduler(settings()));
  return [scene, engine, at = std::int64_t{0}](std::int64_t frames) mutable {
    for (const std::int64_t end = at + frames; at < end; ++at) {
      const auto view = scene->frame(at).view();
      SourceFrame frame;
      frame.pixels = {view.data, view.width, view.height, 1, view.pitch};
      frame.owner = scene;
      frame.time = static_cast<double>(at);
      engine->push(std::move(frame));
      while (engine->poll()) {
      }
    }
    engine->drain();
  };
}

void check(glint_status status) {
  if (status != GLINT_OK) throw std::runtime_error(glint_last_error());
}

std::shared_ptr<glint_engine> engine_in_c() {
  glint_options options = GLINT_OPTIONS_INIT;
  options.tracker = kTracker, options.config = kSettings;
  glint_engine* engine = nullptr;
  check(glint_create(&options, &engine));
  return {engine, glint_destroy};
}

Way pushed_in_c(const Scene& scene) {
  return [scene, engine = engine_in_c(), at = std::int64_t{0}](std::int64_t frames) mutable {
    std::array<glint_track, 1000> tracks;
    glint_result result = GLINT_RESULT_INIT;
    for (const std::int64_t end = at + frames; at < end; ++at) {
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
    }
    check(glint_drain(engine.get()));
  };
}

/// Rows one after the other.
std::vector<std::uint16_t> packed(const MemoryScene& scene, std::int64_t frame) {
  const auto view = scene.frame(frame).view();
  std::vector<std::uint16_t> pixels;
  for (int y = 0; y < view.height; ++y) {
    pixels.insert(pixels.end(), view.row(y), view.row(y) + view.width);
  }
  return pixels;
}

/// The scene's images in a file that is gone at the end.
class ImageFile {
 public:
  explicit ImageFile(const MemoryScene& scene)
      : path_(fs::temp_directory_path() / fmt::format("glint_embed_{}.raw", getpid())) {
    std::ofstream file(path_, std::ios::binary);
    for (int i = 0; i < kImages; ++i) {
      const auto pixels = packed(scene, i);
      const auto bytes = std::as_bytes(std::span(pixels));
      file.write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
    }
    if (!file.flush()) throw std::runtime_error(path_.string() + ": cannot be written");
  }
  ~ImageFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  ImageFile(const ImageFile&) = delete;
  ImageFile& operator=(const ImageFile&) = delete;
  std::string path() const { return path_.string(); }

 private:
  fs::path path_;
};

// Plays the images forth and back, as MemoryScene does; a line in says how many frames, a line out
// that they are done.
constexpr const char* kPython = R"(
import sys
import numpy
import glint

path, height, width, tracker, config = sys.argv[1:]
images = numpy.fromfile(path, numpy.uint16).reshape(-1, int(height), int(width))
period = 2 * len(images) - 2
engine = glint.Engine(tracker, config=config)
at = 0
print('ready', flush=True)
for line in sys.stdin:
    for at in range(at, at + int(line)):
        phase = at % period
        engine.push(images[min(phase, period - phase)], at)
        while engine.poll() is not None:
            pass
    at += 1
    engine.drain()
    print('done', flush=True)
)";

fs::path program() { return fs::read_symlink("/proc/self/exe"); }

/// Nothing where Python or its module is missing.
Way pushed_in_python(const ImageFile& images) {
  const char* path = std::getenv("PYTHONPATH");
  // In the build folder the module lies beside the program's folder.
  const std::string module = (program().parent_path().parent_path() / "python").string();
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    const auto child = std::make_shared<Child>(
        std::vector<std::string>{
            "env", "PYTHONPATH=" + module + (path != nullptr ? std::string(":") + path : ""),
            python, "-c", kPython, images.path(), std::to_string(kHeight), std::to_string(kWidth),
            kTracker, kSettings},
        Child::Output::read);
    if (child->line() != "ready") continue;
    return [child](std::int64_t frames) {
      const std::string line = std::to_string(frames) + "\n";
      child->write(std::as_bytes(std::span(line)));
      if (child->line() != "done") throw std::runtime_error("Python ended before its frames did");
    };
  }
  fmt::print(stderr, "bench: Python left out: no python3 that imports glint and numpy\n");
  return nullptr;
}

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A frame's time [s] in a program that reads frames from its standard input, after its first ones.
/// A pipe holds less than a frame: each is written as fast as the program takes it.
double piped(const std::vector<std::string>& command, const MemoryScene& scene, std::int64_t first,
             std::int64_t frames) {
  Child child(command, Child::Output::dropped);
  std::int64_t at = 0;
  const auto write_until = [&](std::int64_t end) {
    for (; at < end; ++at) {
      const auto pixels = packed(scene, at);
      child.write(std::as_bytes(std::span(pixels)));
    }
  };
  write_until(first);
  const double seconds = seconds_of([&] { write_until(first + frames); });
  if (child.wait() != 0) throw std::runtime_error(command.front() + " failed");
  return seconds / static_cast<double>(frames);
}

/// GStreamer's program with the plugin of the build folder, or the installed one.
std::vector<std::string> with_plugin(std::vector<std::string> command) {
  const char* path = std::getenv("GST_PLUGIN_PATH");
  const std::string plugin = (program().parent_path().parent_path() / "gstreamer").string();
  command.insert(command.begin(), {"env", "GST_PLUGIN_PATH=" + plugin +
                                              (path != nullptr ? std::string(":") + path : "")});
  return command;
}

/// Nothing where GStreamer or the plugin is missing.
std::vector<std::string> gstreamer_command() {
  if (Child(with_plugin({"gst-inspect-1.0", "glinttrack"}), Child::Output::dropped).wait() != 0) {
    fmt::print(stderr, "bench: GStreamer left out: no gst-inspect-1.0 that knows glinttrack\n");
    return {};
  }
  const std::string width = fmt::format("width={}", kWidth),
                    height = fmt::format("height={}", kHeight);
  const std::string frame = fmt::format("blocksize={}", 2 * kWidth * kHeight);
  return with_plugin({"gst-launch-1.0", "-q", "fdsrc", "fd=0", frame, "!", "rawvideoparse",
                      "format=gray16-le", width, height, "framerate=1/1", "!", "glinttrack",
                      std::string("tracker=") + kTracker, "set=run.keep=60", "!", "fakesink"});
}

std::vector<std::string> pipe_command() {
  return {program().string(),
          "track",
          "-",
          "--format",
          "gray16le",
          "--size",
          fmt::format("{}x{}", kWidth, kHeight),
          "--tracker",
          kTracker,
          "--set",
          "run.keep=60",
          "--out",
          "-"};
}

}  // namespace

std::vector<bench::Result> bench_embed(const bench::Options& options) {
  const auto scene = std::make_shared<const MemoryScene>(
      kWidth, kHeight, MemoryScene::Content{kImages, kImages, 20, 10});
  const ImageFile images(*scene);
  bench::Suite suite(
      fmt::format("ways into the engine: {}x{} uint16, {}", kWidth, kHeight, kTracker), "frame");
  const std::int64_t frames = options.quick ? 16 : 64;
  const auto add = [&](const std::string& name, const Way& way) {
    if (!way) return;
    way(FramesConfig{}.background_frames);
    suite.add({name, kThreads, static_cast<double>(frames), [way, frames] { way(frames); }, true});
    if (name == kPlain) return;
    suite.ratio(name + kOverPlain, kPlain, name, {{}, kMostOverPlain, true});
  };
  const auto plain =
      std::make_shared<bench::WarmEngine>(scene, std::vector<std::string>{kTracker}, Device::tbb());
  add(kPlain, [plain](std::int64_t count) { plain->advance(count); });
  add("C++, Engine::push()", pushed_in_cpp(scene));
  add("C, glint_push()", pushed_in_c(scene));
  add("Python, Engine.push()", pushed_in_python(images));
  bench::Result result =
      measure(suite, options.quick ? bench::Budget{3, 2} : bench::Budget{25, 40});
  // By the end of the first frames the targets are followed.
  const std::int64_t first = (options.quick ? 1 : 2) * FramesConfig{}.background_frames;
  for (const auto& [name, command] : {std::pair{"pipe, glint track -", pipe_command()},
                                      std::pair{"GStreamer, glinttrack", gstreamer_command()}}) {
    if (command.empty()) continue;
    const double seconds = piped(command, *scene, first, options.quick ? 16 : 256);
    result.timings.push_back(bench::one_timing(name, kThreads, seconds, 1));
    result.figures.push_back(
        {std::string(name) + kOverPlain, seconds * result.timings.front().rate, {}});
  }
  if (options.done) options.done(result);
  return {result};
}

}  // namespace glint::cli
