// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/embed/bench_embed.hpp"

#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "glint/bench/embed/child.hpp"
#include "glint/bench/embed/embed_ways.hpp"
#include "glint/bench/engine_run.hpp"
#include "glint/bench/together.hpp"
#include "glint/engine/frames/frame_preparer.hpp"

namespace glint::bench {
namespace {

constexpr int kThreads = 2;
constexpr std::int64_t kSample = 16;  // frames: few, so that other work spoils few of many samples
constexpr double kMostOverhead = 0.02;
constexpr const char* kPlain = "plain pipeline";
constexpr const char* kOverPlain = ", time of a frame over the plain one's";
constexpr const char* kOwnTime = ", caller's share of a plain frame";

/// What a way's caller was on a core for.
struct OwnTime {
  std::string way;
  double seconds = 0;
  std::int64_t frames = 0;
};

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
  const std::string width = fmt::format("width={}", kEmbedWidth),
                    height = fmt::format("height={}", kEmbedHeight);
  const std::string frame = fmt::format("blocksize={}", 2 * kEmbedWidth * kEmbedHeight);
  return with_plugin({"gst-launch-1.0", "-q", "fdsrc", "fd=0", frame, "!", "rawvideoparse",
                      "format=gray16-le", width, height, "framerate=1/1", "!", "glinttrack",
                      std::string("tracker=") + kEmbedTracker, "set=run.keep=60", "!", "fakesink"});
}

std::vector<std::string> pipe_command() {
  return {(program().parent_path() / "glint").string(),
          "track",
          "-",
          "--format",
          "gray16le",
          "--size",
          fmt::format("{}x{}", kEmbedWidth, kEmbedHeight),
          "--tracker",
          kEmbedTracker,
          "--set",
          "run.keep=60",
          "--out",
          "-"};
}

/// The plain pipeline and the ways that push, side by side.
Result measure_pushes(const EmbedScene& scene, bool quick) {
  const ImageFile images(*scene);
  Suite suite(fmt::format("ways into the engine: {}x{} uint16, {}", kEmbedWidth, kEmbedHeight,
                          kEmbedTracker),
              "frame");
  const auto add_case = [&](const std::string& name, const std::function<void()>& run) {
    suite.add({name, kThreads, double{kSample}, run, true});
  };
  const std::int64_t warm_up = FramesConfig{}.background_frames;
  WarmEngine plain(scene, {kEmbedTracker}, Device::tbb());
  plain.advance(warm_up);
  add_case(kPlain, [&] { plain.advance(kSample); });
  std::deque<OwnTime> own_times;
  for (const auto& [name, way] : {std::pair{"C++, Engine::push()", pushed_in_cpp(scene)},
                                  std::pair{"C, glint_push()", pushed_in_c(scene)},
                                  std::pair{"Python, Engine.push()", pushed_in_python(images)}}) {
    if (!way) continue;
    way(warm_up);
    OwnTime& own = own_times.emplace_back(OwnTime{name});
    add_case(name, [way = way, &own] { own.seconds += way(kSample), own.frames += kSample; });
    suite.ratio(std::string(name) + kOverPlain, kPlain, name, {{}, 1 + kMostOverhead, true});
  }
  Result result = measure(suite, quick ? Budget{3, 2} : Budget{200, 60});
  const double plain_rate = result.timings.front().rate;
  for (const OwnTime& own : own_times) {
    const double seconds = own.seconds / static_cast<double>(own.frames);
    result.figures.push_back({own.way + kOwnTime, seconds * plain_rate, {{}, kMostOverhead, true}});
  }
  return result;
}

}  // namespace

std::vector<Result> bench_embed(const Options& options) {
  const auto scene = std::make_shared<const MemoryScene>(
      kEmbedWidth, kEmbedHeight, MemoryScene::Content{kEmbedImages, kEmbedImages, 20, 10});
  Result result = measure_pushes(scene, options.quick);
  // By the end of the first frames the targets are followed.
  const std::int64_t first = (options.quick ? 1 : 2) * FramesConfig{}.background_frames;
  for (const auto& [name, command] : {std::pair{"pipe, glint track -", pipe_command()},
                                      std::pair{"GStreamer, glinttrack", gstreamer_command()}}) {
    if (command.empty()) continue;
    const double seconds = piped(command, *scene, first, options.quick ? kSample : 256);
    result.timings.push_back(one_timing(name, kThreads, seconds, 1));
    result.figures.push_back(
        {std::string(name) + kOverPlain, seconds * result.timings.front().rate, {}});
  }
  if (options.done) options.done(result);
  return {result};
}

}  // namespace glint::bench
