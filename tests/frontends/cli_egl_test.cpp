// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "cli.hpp"
#include "egl.hpp"
#include "glint/kernels/core/gl_context.hpp"

namespace glint::test {
namespace {

const std::string kTrack = "track scene:crossing --set scenes.crossing.frames=4 --tracker smc-phd ";

/// A machine on which `environment` breaks EGL: egl says so in one sentence, auto runs.
void expect_no_egl(const Folder& folder, const std::string& environment, const std::string& why) {
  const Result asked = glint(folder, kTrack + "--device egl", environment);
  EXPECT_EQ(asked.code, 1) << asked.err;
  EXPECT_TRUE(has(asked.err, "glint: no EGL device: ")) << asked.err;
  EXPECT_TRUE(has(asked.err, why)) << asked.err;
  EXPECT_TRUE(has(asked.err, "use --device tbb")) << asked.err;
  const Result info = glint(folder, "info", environment);
  EXPECT_EQ(info.code, 0) << info.err;
  EXPECT_TRUE(has(info.out, "no EGL device: ")) << info.out;
  EXPECT_TRUE(has(info.out, "tbb: there is no GPU")) << info.out;
  const Result run = glint(folder, kTrack + "--out " + (folder / "t.csv"), environment);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(has(run.out, "auto       tbb: there is no GPU")) << run.out;
  EXPECT_FALSE(content_of(folder / "t.csv").empty());
}

TEST(CliEgl, AMissingLibraryIsASentenceAndLeavesTheProcessor) {
  const Folder folder;
  folder.write("libEGL.so.1", "no library");
  expect_no_egl(folder, "LD_LIBRARY_PATH=" + folder.path(), "libEGL.so.1");
}

TEST(CliEgl, NoDriverIsASentenceAndLeavesTheProcessor) {
  const Folder folder;
  expect_no_egl(folder, "__EGL_VENDOR_LIBRARY_FILENAMES=" + (folder / "none.json"),
                "libgl1-mesa-dri");
  expect_no_egl(folder,
                "LIBGL_DRIVERS_PATH=" + folder.path() + " LD_LIBRARY_PATH=", "libgl1-mesa-dri");
}

TEST(CliEgl, ABrokenVendorFileIsASentenceAndLeavesTheProcessor) {
  const Folder folder;
  const std::string vendor = folder.write("broken.json", "{\"ICD\": ");
  expect_no_egl(folder, "__EGL_VENDOR_LIBRARY_FILENAMES=" + vendor, "libgl1-mesa-dri");
}

TEST(CliEgl, InfoListsDevicesAndWhichKernelsRunThere) {
  GLINT_NEEDS_EGL(device);
  const Folder folder;
  const Result info = glint(folder, "info");
  EXPECT_EQ(info.code, 0) << info.err;
  EXPECT_TRUE(has(info.out, device.description())) << info.out;
  EXPECT_TRUE(has(info.out, "of them on egl  prepare_frame pixel_likelihood")) << info.out;
  if (device.context().device().software) {  // then no device is hardware
    EXPECT_TRUE(has(info.out, "tbb: there is no GPU")) << info.out;
  }
}

TEST(CliEgl, TracksOnTheDevice) {
  GLINT_NEEDS_EGL(device);
  const Folder folder;
  const std::string number = std::to_string(device.context().device().number);
  for (const std::string& name : {std::string("egl"), "egl:" + number}) {
    const std::string out = folder / (name + ".csv");
    const Result run = glint(folder, kTrack + "--device " + name + " --out " + out);
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_TRUE(has(content_of(out), "device = \"" + name)) << content_of(out);
  }
  expect_error(glint(folder, kTrack + "--device egl:99"), 2, "this machine has egl:0");
}

}  // namespace
}  // namespace glint::test
