// SPDX-License-Identifier: Apache-2.0
// GStreamer's own programs with the plugin, and what the plugin shows.
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "frontends/folder.hpp"
#include "pipeline.hpp"

namespace glint::test {
namespace {

struct Output {
  int code;
  std::string text;
};

Output output_of(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  Output output{-1, {}};
  std::array<char, 4096> buffer;
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe)) {
    output.text.append(buffer.data(), n);
  }
  const int status = pclose(pipe);
  output.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return output;
}

/// The command that README.md shows.
std::string readme_command() {
  std::ifstream readme(GLINT_README);
  for (std::string line; std::getline(readme, line);) {
    if (line.starts_with("    gst-launch-1.0")) return line.substr(4);
  }
  return {};
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++n;
  return n;
}

TEST(GlintTrackLaunch, TheCommandOfTheReadmeTracksAClip) {
  load_gstreamer();
  for (const char* element : {"videotestsrc", "jpegenc", "avimux", "avidemux", "jpegdec"}) {
    GstElementFactory* factory = gst_element_factory_find(element);
    if (factory == nullptr) GTEST_SKIP() << "NOT TESTED: GStreamer has no element " << element;
    gst_object_unref(factory);
  }
  const Folder folder;
  const Output made = output_of(
      "gst-launch-1.0 -q videotestsrc pattern=ball num-buffers=30 ! "
      "video/x-raw,width=96,height=64,framerate=30/1 ! jpegenc ! avimux ! filesink location=" +
      (folder / "clip.mp4"));
  ASSERT_EQ(made.code, 0) << made.text;
  const std::string command = readme_command();
  ASSERT_TRUE(has(command, "glinttrack")) << command;
  const Output run = output_of("cd " + folder.path() + " && " + command);
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_EQ(count(run.text, "glint-tracks, frame="), 30u) << run.text;
  EXPECT_EQ(count(run.text, "glint-revised, frames=(gint64)30"), 1u);
  EXPECT_TRUE(has(run.text, "confirmed"));
}

TEST(GlintTrackLaunch, InspectionTeaches) {
  load_gstreamer();
  const Output inspected = output_of("gst-inspect-1.0 glinttrack");
  ASSERT_EQ(inspected.code, 0) << inspected.text;
  for (const char* part : {"GRAY16_LE", "GRAY8", "tracker  ", "smc-phd, mm-phd", "config-file",
                           "overlay", "glint-tracks", "Apache 2.0"}) {
    EXPECT_TRUE(has(inspected.text, part)) << part << "\n" << inspected.text;
  }
}

TEST(GlintTrackLaunch, ThePluginShowsItsEntriesAlone) {
  std::istringstream symbols(
      output_of(std::string(GLINT_NM) + " -D --defined-only --format=posix " + GLINT_PLUGIN).text);
  int shown = 0;
  for (std::string line; std::getline(symbols, line); ++shown) {
    EXPECT_TRUE(line.starts_with("gst_plugin_glint_")) << line;
  }
  EXPECT_EQ(shown, 2);
}

}  // namespace
}  // namespace glint::test
