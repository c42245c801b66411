// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/cli/commands.hpp"

#include <fmt/core.h>

#include "glint/frontends/cli/run_app.hpp"

namespace glint::cli {

std::span<void (*const)(CLI::App&)> all_commands() {
  static constexpr void (*kCommands[])(CLI::App&) = {
      add_track,     add_simulate, add_evaluate, add_points, add_experiment,
      add_calibrate, add_bench,    add_parity,   add_info,   add_config};
  return kCommands;
}

int run(int argc, char** argv) {
  CLI::App app(
      "Finds and follows targets that are too dim for any single frame (track before detect).",
      "glint");
  app.set_version_flag("--version", "glint " GLINT_VERSION);
  app.footer(
      "Examples:\n"
      "  glint track clip.mp4 --tracker smc-phd --out tracks.csv --overlay overlay.mp4\n"
      "  glint COMMAND --help\n"
      "Exit codes: 0 done, 1 failed while running, 2 wrong use.");
  app.require_subcommand(0, 1);
  for (const auto add : all_commands()) add(app);
  app.callback([&app] {
    if (app.get_subcommands().empty()) fmt::print("{}", app.help());
  });
  return run_app(app, argc, argv);
}

}  // namespace glint::cli
