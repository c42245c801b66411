// SPDX-License-Identifier: Apache-2.0
#include "cli.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "glint/frontends/files/tables.hpp"

namespace glint::test {
namespace {

TEST(Cli, ShowsHelpAndVersion) {
  const Folder folder;
  for (const std::string arguments : {"", "--help", "track --help"}) {
    const Result result = glint(folder, arguments);
    EXPECT_EQ(result.code, 0);
    EXPECT_TRUE(has(result.out, "glint track clip.mp4")) << result.out;
  }
  EXPECT_TRUE(has(glint(folder, "--version").out, "glint 0."));
  EXPECT_TRUE(has(glint(folder, "info").out, "smc-phd"));
}

TEST(Cli, WrongUseIsExitCodeTwoAndOneLine) {
  const Folder folder;
  const std::string run = "track scene:noise --tracker smc-phd ";
  expect_error(glint(folder, "dance"), 2, "dance");
  expect_error(glint(folder, "track"), 2, "INPUT");
  expect_error(glint(folder, "track scene:noise"), 2, "--tracker");
  expect_error(glint(folder, "track scene:noise --tracker foo"), 2, "smc-phd");
  expect_error(glint(folder, "track scene:foo --tracker smc-phd"), 2, "noise");
  expect_error(glint(folder, "track none.mp4 --tracker smc-phd"), 2, "none.mp4");
  expect_error(glint(folder, run + "--device gpu"), 2, "use auto, serial, tbb, egl or egl:N");
  expect_error(glint(folder, run + "--set no_such=1"), 2, "no_such");
  expect_error(glint(folder, run + "--set birth_particles=0"), 2, "must be in");
  expect_error(glint(folder, run + "--seed x"), 2, "run.seed");
  expect_error(glint(folder, run + "--tracker smc-phd"), 2, "given twice");
  expect_error(glint(folder, "experiment phd-5.1 --seed -1"), 2, "--seed");
  expect_error(glint(folder, "evaluate --truth t --tracks t --frames -3"), 2, "--frames");
  expect_error(glint(folder, run + "--out " + (folder / "no/t.csv")), 2, "no/t.csv");
  expect_error(glint(folder, run + "--config " + (folder / "no.toml")), 2, "no.toml");
  folder.write("c.toml", "[frames]\n\npolarity = \"up\"\n");
  expect_error(glint(folder, run + "--config " + (folder / "c.toml")), 2, "c.toml:3:");
}

TEST(Cli, ATruncatedInputIsExitCodeOne) {
  const Folder folder;
  const std::string path = cube(folder, 32, 32, 4, 1, 1);
  truncate(path, 0.5);
  expect_error(glint(folder, "track " + path + " --tracker smc-phd"), 1, "truncated");
}

TEST(Cli, OddInputsHaveADefinedResult) {
  const Folder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const auto runs = [&](int width, int height, int frames, float value, float odd) {
    const Result result = glint(folder, "track " + cube(folder, width, height, frames, value, odd) +
                                            " --tracker smc-phd --out " + (folder / "t.csv"));
    EXPECT_EQ(result.code, 0) << width << "x" << height << ": " << result.err;
    for (const TrackPoint& p : read_tracks(folder / "t.csv")) {
      EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
    }
  };
  runs(32, 32, 6, 1, nan);
  runs(32, 32, 6, 1, inf);
  runs(32, 32, 6, 0, 0);  // all zero
  runs(32, 32, 1, 1, 1);  // one frame
  runs(3, 2, 6, 1, 1);    // smaller than the window
  runs(1, 1, 6, 1, 1);
  runs(32, 32, 6, nan, nan);  // nothing but NaN
}

TEST(Cli, ConfigOfATrackerIsAFileThatChangesNothing) {
  const Folder folder;
  const Result config = glint(folder, "config smc-phd");
  ASSERT_EQ(config.code, 0);
  folder.write("c.toml", config.out);
  const std::string run = "track scene:phd-5.1 --out ";
  ASSERT_EQ(glint(folder, run + (folder / "1.csv") + " --tracker smc-phd").code, 0);
  ASSERT_EQ(glint(folder, run + (folder / "2.csv") + " --config " + (folder / "c.toml")).code, 0);
  EXPECT_EQ(content_of(folder / "1.csv"), content_of(folder / "2.csv"));
}

TEST(Cli, MaskedPixelsFindNothing) {
  const Folder folder;
  const std::string clip = folder / "clip";
  ASSERT_EQ(glint(folder, "simulate crossing --format npy --out " + clip).code, 0);
  const auto source = open_npy(clip + "/frames.npy");
  const auto frame = source->next();
  Image<float> mask(frame->pixels.width, frame->pixels.height);
  for (int y = 0; y < mask.height(); ++y) std::fill_n(mask.view().row(y), mask.width(), 1.0f);
  NpyWriter(folder / "mask.npy").write(mask.view());
  const std::string out = folder / "p.csv";
  for (const std::string detector : {"matched-filter", "wavelet"}) {
    const std::string points =
        "points " + clip + " --threshold 3 --detector " + detector + " --out " + out;
    ASSERT_EQ(glint(folder, points).code, 0);
    EXPECT_GT(read_points(out).size(), 0u);
    ASSERT_EQ(glint(folder, points + " --mask " + (folder / "mask.npy")).code, 0);
    EXPECT_EQ(read_points(out).size(), 0u);
  }
}

}  // namespace
}  // namespace glint::test
