// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/frontends/cli/command.hpp"

namespace glint::cli {

// A subcommand is one file with one function: it adds a Command to `program`, its options, an
// example or two as the footer, and a callback that does the work. The callback returns when all is
// done (exit code 0), throws UsageError or ConfigError for wrong use (2) and any other exception
// for a failure (1); Program::run() prints the message as "glint: <message>". What a callback needs
// lives in a std::shared_ptr that it captures. Results go to stdout, progress and warnings to
// stderr.
void add_track(Command& program);
void add_simulate(Command& program);
void add_evaluate(Command& program);
void add_points(Command& program);
void add_info(Command& program);
void add_config(Command& program);
/// Those that other programs do: add_experiment() and so on, in glint-experiments, and glint-bench.
void add_other_programs(Command& program);

/// The program glint: runs the command line, whose subcommands stand in the order of the help text,
/// and returns the exit code.
int run(int argc, char** argv);

// Subcommands of glint-experiments, the program behind `glint experiment`, `calibrate` and
// `parity`: the experiments are as large as the rest, and few runs need them.
void add_experiment(Command& program);
void add_calibrate(Command& program);
void add_parity(Command& program);

struct CommandName {
  const char *name, *description;
};
inline constexpr CommandName kExperiment{"experiment",
                                         "Repeat a paper's experiment beside its table"};
inline constexpr CommandName kCalibrate{
    "calibrate", "A tracker's threshold for a wanted rate of false tracks in white noise"};
inline constexpr CommandName kParity{
    "parity", "Checks every kernel against its reference and that threads change nothing"};

}  // namespace glint::cli
