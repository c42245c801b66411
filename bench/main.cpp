// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/bench.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "glint/bench/embed/bench_embed.hpp"
#include "glint/frontends/cli/command.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint::bench {
namespace {

struct Request {
  std::string what = "kernels";
  std::string size = "4096x4096";
  std::string device = "tbb";
  bool json = false, quick = false;
};

FrameSize parse_size(const std::string& text) {
  FrameSize size;
  char rest = 0;
  const int read = std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest);
  constexpr int kMin = kMinSide, kMax = 32768;
  if (read != 2 || std::min(size.width, size.height) < kMin ||
      std::max(size.width, size.height) > kMax) {
    throw UsageError(fmt::format("--size must be WIDTHxHEIGHT with sides in [{}, {}], got {}", kMin,
                                 kMax, text));
  }
  return size;
}

// 5.23 G, 48.1 M, ...
std::string rate_text(double rate) {
  constexpr const char* kPrefix[] = {"", "k", "M", "G", "T"};
  int i = 0;
  for (; rate >= 1000 && i < 4; ++i) rate /= 1000;
  return fmt::format("{:.4g} {}", rate, kPrefix[i]);
}

void print(const Result& result) {
  fmt::print("\n{}\n", result.name);
  fmt::print("  {:<34}{:>12}{:>22}  samples\n", "case", "ms", "rate");
  for (const Timing& t : result.timings) {
    fmt::print("  {:<34}{:>12.4f}{:>22}  {}{}\n", t.name, t.seconds * 1e3,
               rate_text(t.rate) + result.unit + "/s", t.samples,
               t.disturbed > 0 ? " while other work ran" : "");
  }
  if (result.figures.empty()) return;
  const auto number = [](std::optional<double> x) { return x ? fmt::format("{:.3g}", *x) : "-"; };
  fmt::print("  {:<58}{:>8}{:>9}{:>7}\n", "ratio", "here", "reached", "goal");
  for (const Figure& f : result.figures) {
    fmt::print("  {:<58}{:>8.3g}{:>9}{:>7}  {}\n", f.name, f.value, number(f.target.reached),
               number(f.target.goal), verdict(f));
  }
  std::fflush(stdout);
}

nlohmann::json number_or_null(std::optional<double> x) {
  return x ? nlohmann::json(*x) : nlohmann::json(nullptr);
}

nlohmann::json to_json(const Result& result) {
  nlohmann::json cases = nlohmann::json::array(), figures = nlohmann::json::array();
  for (const Timing& t : result.timings) {
    cases.push_back({{"name", t.name},
                     {"threads", t.threads},
                     {"seconds", t.seconds},
                     {"rate", t.rate},
                     {"samples", t.samples},
                     {"disturbed", t.disturbed}});
  }
  for (const Figure& f : result.figures) {
    figures.push_back({{"name", f.name},
                       {"value", f.value},
                       {"reached", number_or_null(f.target.reached)},
                       {"goal", number_or_null(f.target.goal)},
                       {"at_most", f.target.at_most},
                       {"verdict", verdict(f)}});
  }
  return {{"name", result.name}, {"unit", result.unit}, {"cases", cases}, {"figures", figures}};
}

std::optional<Device> egl_device(const Request& request) {
  if (request.device == "tbb" || request.device == "auto") return std::nullopt;
  const bool measured = request.what == "kernels" || request.what == "frames";
  if (!request.device.starts_with("egl") || !measured) {
    throw UsageError("--device is tbb, or egl or egl:N with kernels and frames, got " +
                     request.device);
  }
  try {
    return Device::named(request.device);
  } catch (const std::invalid_argument& e) {
    throw UsageError(e.what());
  }
}

void run(const Request& request) {
  Options options;
  options.egl = egl_device(request);
  options.size = parse_size(request.size);
  options.quick = request.quick;
  if (!request.json) {
    options.done = print;
    fmt::print("{}; all ratios are of rates measured side by side in this run\n",
               Device::tbb().description());
  }
  const auto results = request.what == "kernels"    ? bench_kernels(options)
                       : request.what == "trackers" ? bench_trackers(options)
                       : request.what == "h-pmht"   ? bench_h_pmht(options)
                       : request.what == "embed"    ? bench_embed(options)
                                                    : bench_frames(options);
  if (!request.json) return;
  nlohmann::json suites = nlohmann::json::array();
  for (const Result& result : results) suites.push_back(to_json(result));
  const nlohmann::json all{{"machine", Device::tbb().description()}, {"suites", suites}};
  fmt::print("{}\n", all.dump(2));
}

void add_options(cli::Command& program) {
  const auto request = std::make_shared<Request>();
  program.option("what", request->what, "kernels, trackers, frames, h-pmht or embed")
      .one_of({"kernels", "trackers", "frames", "h-pmht", "embed"})
      .with_default();
  program.option("--size", request->size, "frame size, WIDTHxHEIGHT [px]").with_default();
  program.option("--device", request->device, "tbb; kernels and frames also on egl or egl:N")
      .with_default();
  program.flag("--quick", request->quick, "fewer samples, no growth over sizes");
  program.flag("--json", request->json, "print JSON instead of tables");
  program.footer(
      "Examples:\n"
      "  glint bench kernels\n"
      "  glint bench kernels --device egl\n"
      "  glint bench frames --device egl --quick\n"
      "  glint bench frames --size 4096x4096 --json");
  program.callback([request] { run(*request); });
}

}  // namespace
}  // namespace glint::bench

/// What `glint bench` starts.
int main(int argc, char** argv) {
  glint::cli::Program program(
      "glint bench", "Measures kernels, trackers or the whole engine beside the machine's limits");
  glint::bench::add_options(program);
  return program.run(argc, argv);
}
