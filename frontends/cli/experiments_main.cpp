// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/cli/commands.hpp"

/// The program glint-experiments, which glint becomes for these commands.
int main(int argc, char** argv) {
  using namespace glint::cli;
  Program program("glint",
                  "Experiments of the papers, and what is calibrated and checked by runs.");
  for (const auto add : {add_experiment, add_calibrate, add_parity}) add(program);
  program.helps_without_subcommand();
  return program.run(argc, argv);
}
