// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/experiments/run_file.hpp"

#include <gtest/gtest.h>

#include "cli.hpp"
#include "folder.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint {
namespace {

using test::content_of;
using test::Folder;
using test::has;
using test::message_of;

const RunOrigin kOrigin{"experiment e", "seed 1"};

void fill(const std::string& path) {
  RunFile file(path, kOrigin);
  file.keep({0, 0}, "first");
  file.keep({1, 0}, "");
  file.keep({0, 1}, std::string("last\0one", 8));
}

TEST(RunFile, HasWhatItWasGiven) {
  const Folder folder;
  fill(folder / "a.runs");
  RunFile file(folder / "a.runs", kOrigin);
  EXPECT_EQ(file.kept(), 3U);
  EXPECT_EQ(file.find({0, 0}), "first");
  EXPECT_EQ(file.find({1, 0}), "");
  EXPECT_EQ(file.find({0, 1}), std::string("last\0one", 8));
  EXPECT_FALSE(file.find({1, 1}));
}

TEST(RunFile, DropsWhatWasCutShortAtAnyByteAndGoesOn) {
  const Folder folder;
  const std::string path = folder / "a.runs";
  fill(path);
  const std::string whole = content_of(path);
  const std::size_t header = whole.find("\n\n") + 2;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    std::ofstream(path, std::ios::binary) << whole.substr(0, size);
    RunFile file(path, kOrigin);
    const std::size_t kept = size < header + 29 ? 0 : size < header + 29 + 24 ? 1 : 2;
    ASSERT_EQ(file.kept(), kept) << size;
    if (kept < 1) file.keep({0, 0}, "first");
    if (kept < 2) file.keep({1, 0}, "");
    file.keep({0, 1}, std::string("last\0one", 8));
    ASSERT_EQ(content_of(path), whole) << size;
  }
}

TEST(RunFile, DropsARecordWhoseBytesChanged) {
  const Folder folder;
  const std::string path = folder / "a.runs";
  fill(path);
  std::string bytes = content_of(path);
  bytes.back() ^= 1;
  std::ofstream(path, std::ios::binary) << bytes;
  EXPECT_EQ(RunFile(path, kOrigin).kept(), 2U);
}

TEST(RunFile, RefusesRunsOfAnotherOriginAndSaysWhichLine) {
  const Folder folder;
  fill(folder / "a.runs");
  const std::string said = message_of<UsageError>([&] {
    RunFile(folder / "a.runs", {"experiment e", "seed 2"});
  });
  EXPECT_TRUE(has(said, "'seed 1', not 'seed 2'")) << said;
  EXPECT_TRUE(has(said, "--keep")) << said;
  folder.write("b.runs", "x,y\n1,2\n");
  EXPECT_TRUE(has(message_of<UsageError>([&] { RunFile(folder / "b.runs", kOrigin); }), "x,y"));
}

TEST(RunFile, IsOfOneProcessAtATime) {
  const Folder folder;
  const RunFile file(folder / "a.runs", kOrigin);
  EXPECT_TRUE(has(message_of<UsageError>([&] { RunFile(folder / "a.runs", kOrigin); }), "another"));
}

// Experiments whose results are of different make: structs, vectors, and maps of scores.
void expect_kept_runs_change_nothing(const std::string& name) {
  const Folder folder;
  const std::string run = "experiment " + name + " --out " + folder.path();
  const std::string keep = run + " --keep " + folder.path();
  const std::string curves_file = folder / (name + ".csv");
  const std::string file = folder / (name + "-seed1-threads.runs");
  const test::Result plain = test::glint(folder, run + " --runs 3");
  const std::string curves = content_of(curves_file);
  EXPECT_EQ(test::glint(folder, keep + " --runs 2").code, plain.code);
  const auto two = std::filesystem::file_size(file);
  test::truncate(file, 0.99);  // a run was being written
  EXPECT_EQ(test::glint(folder, keep + " --runs 3").out, plain.out);
  EXPECT_EQ(content_of(curves_file), curves);
  const auto three = std::filesystem::file_size(file);
  EXPECT_GT(three, two);
  EXPECT_EQ(test::glint(folder, keep + " --runs 3").out, plain.out);
  EXPECT_EQ(content_of(curves_file), curves);
  EXPECT_EQ(std::filesystem::file_size(file), three);  // nothing was run
}

TEST(KeptRuns, AreNotRepeatedAndChangeNothing) {
  for (const char* name : {"jpda-coalescence", "pmht-montecarlo", "phd-5.1"}) {
    expect_kept_runs_change_nothing(name);
  }
}

}  // namespace
}  // namespace glint
