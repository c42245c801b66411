// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace glint {
namespace {

namespace fs = std::filesystem;

struct Include {
  std::string file, header;  ///< file relative to the source tree
};

/// The header that a line includes, or nothing.
std::string header_of(const std::string& line) {
  std::size_t at = line.find_first_not_of(" \t");
  if (at == std::string::npos || line[at] != '#') return {};
  at = line.find_first_not_of(" \t", at + 1);
  if (at == std::string::npos || line.compare(at, 7, "include") != 0) return {};
  const std::size_t open = line.find_first_of("<\"", at + 7);
  const std::size_t close = line.find_first_of(">\"", open + 1);
  return close == std::string::npos ? std::string() : line.substr(open + 1, close - open - 1);
}

std::vector<Include> includes_of(const std::string& room) {
  std::vector<Include> found;
  const fs::path root = GLINT_SOURCE_DIR;
  for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
    const std::string extension = entry.path().extension();
    if (extension != ".hpp" && extension != ".cpp" && extension != ".h") continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      const std::string header = header_of(line);
      if (!header.empty()) found.push_back({fs::relative(entry.path(), root).string(), header});
    }
  }
  return found;
}

bool starts_with_any(const std::string& text, const std::vector<std::string_view>& starts) {
  return std::ranges::any_of(starts,
                             [&](std::string_view start) { return text.starts_with(start); });
}

/// Fails for every file of `rooms`, but those that start with one of `allowed`, that includes a
/// header which starts with one of `headers`.
void expect_none(const std::vector<std::string>& rooms,
                 const std::vector<std::string_view>& headers,
                 const std::vector<std::string_view>& allowed = {}) {
  for (const std::string& room : rooms) {
    const std::vector<Include> all = includes_of(room);
    EXPECT_FALSE(all.empty()) << room;
    for (const auto& [file, header] : all) {
      if (starts_with_any(file, allowed)) continue;
      EXPECT_FALSE(starts_with_any(header, headers)) << file << " includes " << header;
    }
  }
}

const std::vector<std::string> kRooms{"kernels", "engine", "experiments", "frontends", "bench"};

TEST(Architecture, KernelsIncludeNothingAboveThem) {
  expect_none({"kernels"},
              {"glint/engine", "glint/experiments", "glint/frontends", "glint/bench", "Eigen"});
}
TEST(Architecture, EngineIncludesNothingAboveIt) {
  expect_none({"engine"}, {"glint/experiments", "glint/frontends", "glint/bench"});
}
TEST(Architecture, ExperimentsStandOnTheEngineAlone) {
  expect_none({"experiments"}, {"glint/frontends", "glint/bench"});
}
TEST(Architecture, FrontEndsDoNotNeedTheBenchmarks) { expect_none({"frontends"}, {"glint/bench"}); }
TEST(Architecture, SharedRoomsOfTheEngineKnowNoTracker) {
  expect_none({"engine/frames", "engine/filters", "engine/tracks", "engine/state"},
              {"glint/engine/trackers"});
}
TEST(Architecture, ATrackerFamilyIncludesNoOther) {
  const fs::path trackers = fs::path(GLINT_SOURCE_DIR) / "engine/trackers";
  std::size_t families = 0;
  for (const auto& entry : fs::directory_iterator(trackers)) {
    if (!entry.is_directory()) continue;
    ++families;
    const std::string own = "glint/engine/trackers/" + entry.path().filename().string() + "/";
    for (const auto& [file, header] : includes_of("engine/trackers/" + own.substr(22))) {
      EXPECT_TRUE(!header.starts_with("glint/engine/trackers/") || header.starts_with(own))
          << file << " includes " << header;
    }
  }
  EXPECT_GE(families, 6u);
}
TEST(Architecture, EigenStaysOutOfTheBytesOfState) {
  expect_none({"engine/state"}, {"Eigen"}, {"engine/state/fields.hpp"});
}
TEST(Architecture, OpenCvStaysInVideoAndInBaselines) {
  expect_none(kRooms, {"opencv"}, {"frontends/video/", "bench/baselines/"});
}
TEST(Architecture, Cli11StaysBehindTheCommand) {
  expect_none(kRooms, {"CLI/"}, {"frontends/cli/command.cpp"});
}
TEST(Architecture, TomlStaysInConfig) { expect_none(kRooms, {"toml++"}, {"frontends/config/"}); }
TEST(Architecture, PythonStaysInItsFrontEnd) {
  expect_none(kRooms, {"pybind11", "Python.h"}, {"frontends/python/"});
}
TEST(Architecture, GStreamerStaysInItsFrontEnd) {
  expect_none(kRooms, {"gst/", "glib"}, {"frontends/gstreamer/"});
}
TEST(Architecture, TbbStaysInKernelsAndTheScheduler) {
  // The tools that count threads may hold a global_control; the library may not.
  const std::vector<std::string_view> headers{"tbb/", "oneapi/tbb"};
  expect_none({"engine"}, headers, {"engine/scheduler_state.cpp"});
  expect_none({"experiments"}, headers);
  expect_none({"frontends", "bench"}, headers, {"frontends/cli/parity.cpp", "bench/baselines/"});
  expect_none({"kernels", "engine"}, {"tbb/global_control", "oneapi/tbb/global_control"});
}
TEST(Architecture, OpenGlStaysInTheCoreAndInGlFiles) {
  const std::vector<std::string_view> headers{"EGL/", "GL/", "glint/kernels/core/gl_",
                                              "glint_shaders/"};
  for (const auto& [file, header] : includes_of("kernels")) {
    const std::string name = fs::path(file).filename().string();
    const bool is_gl = name == "gl.cpp" || (name.starts_with("gl_") && name.ends_with(".cpp"));
    if (file.starts_with("kernels/core/") || is_gl) continue;
    if (file == "kernels/parity.cpp") continue;  // makes buffers small
    EXPECT_FALSE(starts_with_any(header, headers)) << file << " includes " << header;
  }
  expect_none({"engine", "experiments", "frontends", "bench"}, headers);
  expect_none(kRooms, {"EGL/", "GL/"});
}
TEST(Architecture, LibraryNeedsNoFrontEndsPackages) {
  expect_none({"kernels", "engine", "experiments"},
              {"CLI/", "nlohmann", "fmt/", "fitsio", "iostream"});
}
TEST(Architecture, InTreeHeadersAreNamedFromTheirLayer) {
  for (const std::string& room : kRooms) {
    for (const auto& [file, header] : includes_of(room)) {
      EXPECT_FALSE(header.starts_with("..")) << file << " includes " << header;
      const fs::path beside = fs::path(GLINT_SOURCE_DIR) / fs::path(file).parent_path() / header;
      EXPECT_FALSE(fs::exists(beside)) << file << " includes " << header;
    }
  }
}

TEST(IncludeReader, ReadsTheHeaderOfALine) {
  EXPECT_EQ(header_of("#include <tbb/info.h>"), "tbb/info.h");
  EXPECT_EQ(header_of("  # include \"glint/a.hpp\"  // why"), "glint/a.hpp");
  EXPECT_EQ(header_of("// #include <vector>"), "");
  EXPECT_EQ(header_of("#pragma once"), "");
  EXPECT_EQ(header_of(""), "");
}

}  // namespace
}  // namespace glint
