// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/inputs.hpp"

#include <algorithm>

#include "folder.hpp"

namespace glint {
namespace {

using test::Folder;
using test::has;
using test::message_of;

std::vector<std::string> expand(const std::string& input, std::vector<std::string>* warnings = {}) {
  return expand_inputs(std::span(&input, 1), [&](const std::string& w) {
    if (warnings) warnings->push_back(w);
  });
}

TEST(Inputs, NumbersInNamesCompareAsNumbers) {
  std::vector<std::string> names{"f10.png", "f9.png", "f100.png", "a.png", "f009.png", "f.png"};
  std::ranges::sort(names, natural_less);
  const std::vector<std::string> want{"a.png",  "f.png",   "f009.png",
                                      "f9.png", "f10.png", "f100.png"};
  EXPECT_EQ(names, want);
  EXPECT_FALSE(natural_less("f9.png", "f9.png"));
}

TEST(Inputs, AFolderIsItsFramesInNaturalOrder) {
  const Folder folder;
  for (const char* name : {"f10.png", "f2.png", "truth.csv", "notes.txt"}) folder.write(name, "x");
  EXPECT_EQ(expand(folder.path()), (std::vector{folder / "f2.png", folder / "f10.png"}));
}

TEST(Inputs, AFolderOfSeveralKindsIsRefused) {
  const Folder folder;
  folder.write("a.png", "x"), folder.write("b.tif", "x");
  const auto message = message_of<UsageError>([&] { expand(folder.path()); });
  EXPECT_TRUE(has(message, ".png") && has(message, ".tif") && has(message, "%04d")) << message;
}

TEST(Inputs, APatternTakesWhatMatchesAndWarnsOfGaps) {
  const Folder folder;
  for (const char* n : {"f_0007.png", "f_0008.png", "f_0010.png", "f_x.png", "g_0009.png"}) {
    folder.write(n, "x");
  }
  std::vector<std::string> warnings;
  const auto files = expand(folder / "f_%04d.png", &warnings);
  EXPECT_EQ(files,
            (std::vector{folder / "f_0007.png", folder / "f_0008.png", folder / "f_0010.png"}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(has(warnings[0], "from 8 to 10")) << warnings[0];
}

TEST(Inputs, WhatIsNotThereIsNamed) {
  const Folder folder;
  for (const std::string name : {"none.mp4", "f_%04d.png"}) {
    const auto message = message_of<UsageError>([&] { expand(folder / name); });
    EXPECT_TRUE(has(message, name)) << message;
  }
  EXPECT_TRUE(has(message_of<UsageError>([&] { expand(folder.path()); }), "no frames"));
}

TEST(Inputs, UnknownKindsAreRefusedWithTheKnownOnes) {
  const Folder folder;
  const auto message = message_of<UsageError>([&] { expand(folder.write("a.doc", "x")); });
  EXPECT_TRUE(has(message, "a.doc") && has(message, "mp4") && has(message, "fits")) << message;
}

}  // namespace
}  // namespace glint
