// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/cli/commands.hpp"

int main(int argc, char** argv) { return glint::cli::run(argc, argv); }
