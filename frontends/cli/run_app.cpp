// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/cli/run_app.hpp"

#include <fmt/core.h>

#include <exception>
#include <string>
#include <string_view>

#include "glint/engine/config.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint::cli {
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
  const std::string command = &at == &app ? app.get_name() : app.get_name() + " " + at.get_name();
  return fail(2, fmt::format("{} (see {} --help)", error.what(), command));
}

}  // namespace

int run_app(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
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
