// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "glint/frontends/cli/commands.hpp"

namespace glint::cli {
namespace {

/// Becomes the program glint-bench beside this one: benchmarks are large, and few runs need them.
void run_bench(const std::vector<std::string>& arguments) {
  const auto program =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "glint-bench";
  std::vector<std::string> words{"glint bench"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  throw UsageError(program.string() +
                   " cannot be started: " + std::generic_category().message(errno) +
                   "; build the target glint_bench_program, or install all of glint-tools");
}

}  // namespace

void add_bench(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "bench", "Measures kernels, trackers or the whole engine beside the machine's limits");
  command->set_help_flag();  // what follows is all for the other program
  command->prefix_command();
  command->callback([command] { run_bench(command->remaining()); });
}

}  // namespace glint::cli
