// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>

#include "frontends/folder.hpp"

// The fuzzers' functions: here each file of them is compiled with a name of its own.
using Fuzz = int(const std::uint8_t* data, std::size_t size);
extern "C" {
Fuzz fuzz_autoferry, fuzz_capi, fuzz_checkpoint, fuzz_config, fuzz_cues, fuzz_fits, fuzz_npy,
    fuzz_points_csv, fuzz_points_jsonl, fuzz_raw_format, fuzz_tables;
}

namespace glint {
namespace {

struct Fuzzer {
  const char* name;
  Fuzz* run;
  friend void PrintTo(const Fuzzer& fuzzer, std::ostream* out) { *out << fuzzer.name; }
};

class Corpus : public testing::TestWithParam<Fuzzer> {};

/// Inputs that are valid, or that broke something once: whatever is wrong with them is refused.
TEST_P(Corpus, IsReadOrRefused) {
  const auto folder = std::filesystem::path(GLINT_CORPUS) / GetParam().name;
  int inputs = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    const std::string bytes = test::content_of(file.path());
    SCOPED_TRACE(file.path());
    EXPECT_NO_THROW(
        GetParam().run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
    ++inputs;
  }
  EXPECT_GT(inputs, 0) << folder;
}

INSTANTIATE_TEST_SUITE_P(
    Fuzz, Corpus,
    testing::Values(Fuzzer{"autoferry", fuzz_autoferry}, Fuzzer{"capi", fuzz_capi},
                    Fuzzer{"checkpoint", fuzz_checkpoint}, Fuzzer{"config", fuzz_config},
                    Fuzzer{"cues", fuzz_cues}, Fuzzer{"fits", fuzz_fits}, Fuzzer{"npy", fuzz_npy},
                    Fuzzer{"points_csv", fuzz_points_csv},
                    Fuzzer{"points_jsonl", fuzz_points_jsonl},
                    Fuzzer{"raw_format", fuzz_raw_format}, Fuzzer{"tables", fuzz_tables}),
    [](const auto& fuzzer) { return std::string(fuzzer.param.name); });

}  // namespace
}  // namespace glint
