// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/cli/commands.hpp"

namespace glint::cli {

int run(int argc, char** argv) {
  Program glint("glint",
                "Finds and follows targets that are too dim for any single frame (track before "
                "detect).");
  glint.version("glint " GLINT_VERSION);
  glint.footer(
      "Examples:\n"
      "  glint track clip.mp4 --tracker smc-phd --out tracks.csv --overlay overlay.mp4\n"
      "  glint COMMAND --help\n"
      "Exit codes: 0 done, 1 failed while running, 2 wrong use.");
  for (const auto add : {add_track, add_simulate, add_evaluate, add_points, add_other_programs,
                         add_info, add_config}) {
    add(glint);
  }
  glint.helps_without_subcommand();
  return glint.run(argc, argv);
}

}  // namespace glint::cli
