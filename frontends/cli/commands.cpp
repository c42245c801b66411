// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/cli/commands.hpp"

#include <fmt/core.h>

#include <exception>

#include "glint/engine/config.hpp"
#ifdef GLINT_WITH_OPENCV
#include "glint/frontends/video/video_file.hpp"
#endif

namespace glint::cli {

std::span<void (*const)(CLI::App&)> all_commands() {
  static constexpr void (*kCommands[])(CLI::App&) = {
      add_track,     add_simulate, add_evaluate, add_points, add_experiment,
      add_calibrate, add_bench,    add_parity,   add_info,   add_config};
  return kCommands;
}

namespace {

int fail(int code, std::string_view message) {
  fmt::print(stderr, "glint: {}\n", message);
  return code;
}

const CLI::App& deepest(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : deepest(*chosen.front());
}

int parse_error(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error);
  const CLI::App& at = deepest(app);
  const std::string command = &at == &app ? "glint" : "glint " + at.get_name();
  return fail(2, fmt::format("{} (see {} --help)", error.what(), command));
}

}  // namespace

int run(int argc, char** argv) {
#ifdef GLINT_WITH_OPENCV
  quiet_video_libraries();
#endif
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
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) fmt::print("{}", app.help());
    return 0;
  } catch (const CLI::ParseError& e) {
    return parse_error(app, e);
  } catch (const UsageError& e) {
    return fail(2, e.what());
  } catch (const ConfigError& e) {
    return fail(2, e.what());
  } catch (const std::exception& e) {
    return fail(1, e.what());
  }
}

}  // namespace glint::cli
