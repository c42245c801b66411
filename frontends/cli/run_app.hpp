// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <CLI/CLI.hpp>

namespace glint::cli {

/// Parses the command line and runs what it asks for. Returns the exit code: 0 done, 2 for wrong
/// use, 1 for any other failure, whose message goes to standard error.
int run_app(CLI::App& app, int argc, char** argv);

}  // namespace glint::cli
