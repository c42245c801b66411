// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/modules/module.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <sstream>

#include "cli.hpp"
#include "folder.hpp"
#include "glint/frontends/modules/fits.hpp"
#include "glint/frontends/modules/video.hpp"

namespace glint {
namespace {

namespace fs = std::filesystem;
using test::Folder;
using test::has;

/// The shared objects that a run of the program loads, by the dynamic linker's own account.
std::set<std::string> objects_loaded(const Folder& folder, const std::string& arguments) {
  const test::Result run = test::glint(folder, arguments, "LD_DEBUG=files");
  std::istringstream lines(run.err);
  std::set<std::string> objects;
  const std::string mark = "calling init: ";
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(mark);
    if (at != std::string::npos) objects.insert(line.substr(at + mark.size()));
  }
  return objects;
}

// With OpenCV, CFITSIO and MPI it was 253, which took most of the time.
TEST(Modules, HelpLoadsAFewSharedObjects) {
  const Folder folder;
  const std::set<std::string> objects = objects_loaded(folder, "--help");
  EXPECT_GE(objects.size(), 3u);  // the account can be read
  EXPECT_LE(objects.size(), 16u);
  for (const std::string& object : objects) {
    EXPECT_FALSE(has(object, "glint-") || has(object, "opencv") || has(object, "libmpi") ||
                 has(object, "cfitsio"))
        << object;
  }
}

TEST(Modules, ACommandLoadsTheModuleThatItUses) {
  const Folder folder;
  const std::string cube = test::cube(folder, 8, 8, 2, 1, 1);
  const auto loads = [&](const std::string& arguments, const std::string& module) {
    const auto objects = objects_loaded(folder, arguments);
    return std::ranges::any_of(objects, [&](const std::string& o) { return has(o, module); });
  };
  const std::string points = " --out " + (folder / "points.csv");
  EXPECT_FALSE(loads("points " + cube + points, "glint-video.so"));
  if (has_video()) {
    EXPECT_TRUE(loads("points " + (folder.write("a.png", "") + points), "glint-video.so"));
  }
  EXPECT_TRUE(loads("points " + (folder.write("a.fits", "") + points), "glint-fits.so"));
}

TEST(Modules, AMissingOneIsNamedWithTheRemedy) {
  const Folder folder;
  fs::create_directory(folder / "bin");
  fs::copy_file(GLINT_BINARY, folder / "bin/glint");
  const std::string input = folder.write("a.fits", "");
  const std::string err = folder / "err.txt";
  const int status = std::system(
      (folder / "bin/glint points " + input + " --out " + (folder / "p.csv") + " 2>" + err)
          .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  const std::string message = test::content_of(err);
  EXPECT_TRUE(has(message, folder / "lib/glint/glint-fits.so: cannot be opened")) << message;
  EXPECT_TRUE(has(message, "install all of glint-tools")) << message;
}

TEST(Modules, OneThatIsNoModuleIsRefused) {
  const auto message = test::message_of<std::runtime_error>([] { open_module("nothing"); });
  EXPECT_TRUE(has(message, "lib/glint/glint-nothing.so")) << message;
}

TEST(Modules, WhatTheyThrowArrivesAsItIs) {
  const Folder folder;
  const std::string path = folder.write("damaged.fits", "no FITS");
  EXPECT_TRUE(has(test::message_of<std::runtime_error>([&] { fits().open_fits(path); }), path));
  if (!has_video()) GTEST_SKIP() << "built without OpenCV";
  EXPECT_THROW(video().overlay_picture(folder / "o.doc"), UsageError);
  const std::string image = folder.write("damaged.png", "no PNG");
  const auto source = video().open_image(image);
  EXPECT_TRUE(has(test::message_of<std::runtime_error>([&] { source->next(); }), image));
}

}  // namespace
}  // namespace glint
