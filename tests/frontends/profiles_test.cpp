// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/profiles.hpp"

#include <gtest/gtest.h>

#include "cli.hpp"
#include "glint/engine/run_config.hpp"

namespace glint::test {
namespace {

TEST(Profiles, EachFitsTheSettingsThereAre) {
  for (const Profile& profile : all_profiles()) {
    auto sections = all_sections();
    EXPECT_NO_THROW(apply_profile(profile.name, sections)) << profile.name;
  }
}

TEST(Profiles, ConfigPrintsThem) {
  const Folder folder;
  const Result low = glint(folder, "config mm-phd --profile L");
  EXPECT_TRUE(has(low.out, "\nsnr_low = 3.5\n")) << low.out;
  EXPECT_TRUE(has(low.out, "\nbackground_frames = 90\n")) << low.out;
  const Result plain = glint(folder, "config smc-phd --profile P");
  EXPECT_TRUE(has(plain.out, "\nsnr_low = 8.0\n")) << plain.out;
  EXPECT_TRUE(has(plain.out, "\nbackground_frames = 45\n")) << plain.out;
}

TEST(Profiles, FilesAndSetGoBeforeThem) {
  const Folder folder;
  folder.write("c.toml", "[trackers.mm-phd]\nconfirm_hits = 3\n");
  const Result result = glint(
      folder, "track scene:crossing --tracker mm-phd --profile L --config " + (folder / "c.toml") +
                  " --set birth_particles=500 --out " + (folder / "t.csv"));
  ASSERT_EQ(result.code, 0) << result.err;
  const std::string header = content_of(folder / "t.csv");
  EXPECT_TRUE(has(header, "# snr_low = 3.5\n"));
  EXPECT_TRUE(has(header, "# confirm_hits = 3\n"));
  EXPECT_TRUE(has(header, "# birth_particles = 500\n"));
}

TEST(Profiles, AnUnknownOneListsTheNames) {
  const Folder folder;
  expect_error(glint(folder, "track scene:noise --tracker mm-phd --profile X"), 2, "P, L");
  expect_error(glint(folder, "config mm-phd --profile X"), 2, "P, L");
}

}  // namespace
}  // namespace glint::test
