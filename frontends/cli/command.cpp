// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/cli/command.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <string_view>

#include "glint/engine/config.hpp"

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

Option& Option::required() { return option_->required(), *this; }
Option& Option::in_range(int low, int high) { return option_->check(CLI::Range(low, high)), *this; }
Option& Option::in_range(std::int64_t low, std::int64_t high) {
  return option_->check(CLI::Range(low, high)), *this;
}
Option& Option::in_range(double low, double high) {
  return option_->check(CLI::Range(low, high)), *this;
}
Option& Option::one_of(const std::vector<std::string>& values) {
  return option_->check(CLI::IsMember(values)), *this;
}
Option& Option::with_default() { return option_->capture_default_str(), *this; }
Option& Option::one_value() { return option_->allow_extra_args(false), *this; }

Command Command::subcommand(const std::string& name, const std::string& description) {
  return Command(app_->add_subcommand(name, description));
}
Option Command::option(const std::string& name, std::string& value, const std::string& help) {
  return Option(app_->add_option(name, value, help));
}
Option Command::option(const std::string& name, std::vector<std::string>& value,
                       const std::string& help) {
  return Option(app_->add_option(name, value, help));
}
Option Command::option(const std::string& name, int& value, const std::string& help) {
  return Option(app_->add_option(name, value, help));
}
Option Command::option(const std::string& name, std::optional<std::int64_t>& value,
                       const std::string& help) {
  return Option(app_->add_option(name, value, help));
}
Option Command::option(const std::string& name, std::optional<double>& value,
                       const std::string& help) {
  return Option(app_->add_option(name, value, help));
}
Option Command::option(const std::string& name, std::uint64_t& value, const std::string& help) {
  return Option(app_->add_option(name, value, help));
}
Option Command::option(const std::string& name, double& value, const std::string& help) {
  return Option(app_->add_option(name, value, help));
}
Option Command::option(const std::string& name, const std::function<void(const std::string&)>& take,
                       const std::string& help) {
  return Option(app_->add_option_function<std::string>(name, take, help));
}
void Command::flag(const std::string& name, bool& value, const std::string& help) {
  app_->add_flag(name, value, help);
}
void Command::footer(const std::string& text) { app_->footer(text); }
void Command::callback(const std::function<void()>& work) { app_->callback(work); }
void Command::take_words(const std::function<void(const std::vector<std::string>&)>& work) {
  app_->set_help_flag();
  app_->prefix_command();
  app_->callback([app = app_, work] { work(app->remaining()); });
}

Program::Program(const std::string& name, const std::string& description)
    : Command(nullptr), owned_(std::make_unique<CLI::App>(description, name)) {
  app_ = owned_.get();
}
Program::~Program() = default;

void Program::version(const std::string& text) { app_->set_version_flag("--version", text); }

void Program::helps_without_subcommand() {
  app_->require_subcommand(0, 1);
  app_->callback([app = app_] {
    if (app->get_subcommands().empty()) fmt::print("{}", app->help());
  });
}

int Program::run(int argc, char** argv) {
  try {
    app_->parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& e) {
    return parse_error(*app_, e);
  } catch (const UsageError& e) {
    return fail(2, e.what());
  } catch (const ConfigError& e) {
    return fail(2, e.what());
  } catch (const std::exception& e) {
    return fail(1, e.what());
  }
}

}  // namespace glint::cli
