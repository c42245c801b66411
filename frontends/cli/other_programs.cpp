// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "glint/frontends/cli/commands.hpp"

namespace glint::cli {
namespace {

/// Becomes the program `name` beside this one. `target` builds it.
[[noreturn]] void become(const std::string& name, const std::string& target,
                         std::vector<std::string> words) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  throw UsageError(program.string() +
                   " cannot be started: " + std::generic_category().message(errno) +
                   "; build the target " + target + ", or install all of glint-tools");
}

void add_experiments_command(Command& program, const CommandName& it) {
  program.subcommand(it.name, it.description).take_words([name = it.name](const auto& rest) {
    std::vector<std::string> words{"glint", name};
    words.insert(words.end(), rest.begin(), rest.end());
    become("glint-experiments", "glint_experiments_program", words);
  });
}

void add_bench(Command& program) {
  program
      .subcommand("bench",
                  "Measures kernels, trackers or the whole engine beside the machine's limits")
      .take_words([](const auto& rest) {
        std::vector<std::string> words{"glint bench"};
        words.insert(words.end(), rest.begin(), rest.end());
        become("glint-bench", "glint_bench_program", words);
      });
}

}  // namespace

void add_other_programs(Command& program) {
  add_experiments_command(program, kExperiment);
  add_experiments_command(program, kCalibrate);
  add_bench(program);
  add_experiments_command(program, kParity);
}

}  // namespace glint::cli
