// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <CLI/CLI.hpp>
#include <span>

#include "glint/frontends/usage_error.hpp"

namespace glint::cli {

// A subcommand is one file with one function: it adds a CLI::App to `app`, its options, an
// example or two as the footer, and a callback that does the work. The callback returns when all is
// done (exit code 0), throws UsageError or ConfigError for wrong use (2) and any other exception
// for a failure (1); main prints the message as "glint: <message>". What a callback needs lives in
// a std::shared_ptr that it captures. Results go to stdout, progress and warnings to stderr.
void add_track(CLI::App& app);
void add_simulate(CLI::App& app);
void add_evaluate(CLI::App& app);
void add_points(CLI::App& app);
void add_experiment(CLI::App& app);
void add_calibrate(CLI::App& app);
void add_bench(CLI::App& app);
void add_parity(CLI::App& app);
void add_info(CLI::App& app);
void add_config(CLI::App& app);

/// The one list of subcommands, in the order of the help text.
std::span<void (*const)(CLI::App&)> all_commands();

/// Runs the command line; returns the exit code.
int run(int argc, char** argv);

}  // namespace glint::cli
