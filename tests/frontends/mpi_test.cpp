// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "cli.hpp"
#include "folder.hpp"

namespace glint {
namespace {

using test::content_of;
using test::Folder;
using test::has;

const std::string kThree = GLINT_MPIEXEC " --allow-run-as-root --oversubscribe -n 3";
// Waiting for each other by turns on few cores.
const std::string kShare = " --threads 1";

TEST(Mpi, ThreeProcessesPrintAndWriteWhatOneDoes) {
  for (const char* name : {"jpda-coalescence", "phd-5.1"}) {
    const Folder folder;
    const std::string run =
        std::string("experiment ") + name + " --runs 4 --out " + folder.path() + kShare;
    const auto figures = [&] { return content_of(folder / (std::string(name) + ".csv")); };
    const test::Result one = test::glint(folder, run);
    const std::string curves = figures();
    const test::Result three = test::glint(folder, run, kThree);
    EXPECT_FALSE(one.out.empty());
    EXPECT_EQ(three.out, one.out) << three.err;
    EXPECT_EQ(figures(), curves);
    EXPECT_EQ(three.code, one.code);
  }
}

TEST(Mpi, TellsOfItsProgressOnce) {
  const Folder folder;
  const test::Result three =
      test::glint(folder, "experiment jpda-coalescence --runs 8" + kShare, kThree);
  const std::string last = "80 of 80 runs\n";
  const std::size_t at = three.err.find(last);
  ASSERT_NE(at, std::string::npos) << three.err;
  EXPECT_EQ(three.err.find(last, at + 1), std::string::npos) << three.err;
}

TEST(Mpi, GoesOnWithWhatOneProcessKeptAndTheOtherWayRound) {
  const Folder folder;
  const std::string run = "experiment jpda-coalescence" + kShare;
  const std::string plain = test::glint(folder, run + " --runs 9").out;
  const std::string keep = " --keep " + folder.path();
  test::glint(folder, run + keep + " --runs 3");
  test::glint(folder, run + keep + " --runs 6", kThree);
  const std::string file = folder / "jpda-coalescence-seed1-threads.runs";
  test::truncate(file, 0.99);
  EXPECT_EQ(test::glint(folder, run + keep + " --runs 9", kThree).out, plain);
  const auto size = std::filesystem::file_size(file);
  EXPECT_EQ(test::glint(folder, run + keep + " --runs 9").out, plain);
  EXPECT_EQ(std::filesystem::file_size(file), size);  // nothing was run
}

TEST(Mpi, SaysWhichProcessWasKilledAndKeepsWhatIsDone) {
  const Folder folder;
  const std::string run = "experiment jpda-coalescence --keep " + folder.path() + kShare;
  const std::string script = folder.write(
      "run.sh",
      "[ \"$OMPI_COMM_WORLD_RANK\" = 2 ] && (sleep 2; kill -9 $$) &\nexec \"$@\" --runs 50000\n");
  const test::Result killed = test::glint(folder, run, kThree + " sh " + script);
  EXPECT_NE(killed.code, 0);
  EXPECT_TRUE(has(killed.err, "rank 2")) << killed.err;
  EXPECT_TRUE(has(killed.err, "signal 9")) << killed.err;
  EXPECT_EQ(killed.out, "");
  const std::string file = folder / "jpda-coalescence-seed1-threads.runs";
  const auto size = std::filesystem::file_size(file);
  EXPECT_GT(size, 1000U);
  const std::string few = "experiment jpda-coalescence --runs 2" + kShare;
  EXPECT_EQ(test::glint(folder, few + " --keep " + folder.path()).out,
            test::glint(folder, few).out);
  EXPECT_LE(std::filesystem::file_size(file), size);  // the first two were kept
}

TEST(Mpi, AProcessThatFailsEndsAllAndSaysWhy) {
  const Folder folder;
  const test::Result failed = test::glint(
      folder, "experiment jpda-coalescence --runs 9 --keep /dev/null/a" + kShare, kThree);
  EXPECT_EQ(failed.code, 1) << failed.err;
  EXPECT_TRUE(has(failed.err, "glint: process 0 of 3 failed: /dev/null/a")) << failed.err;
  EXPECT_EQ(failed.out, "");
}

}  // namespace
}  // namespace glint
