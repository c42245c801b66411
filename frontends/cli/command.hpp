// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "glint/frontends/usage_error.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

// The command line as its commands see it. CLI11 stands behind it, in command.cpp alone: it is a
// header that takes seconds to compile wherever it is included.
namespace glint::cli {

/// An option or positional of a command, and what is asked of it.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}
  Option& required();
  Option& in_range(int low, int high);
  Option& in_range(std::int64_t low, std::int64_t high);
  Option& in_range(double low, double high);
  Option& one_of(const std::vector<std::string>& values);
  Option& with_default();  ///< the help shows the variable's value as the default
  Option& one_value();     ///< repeatable, one value each time

 private:
  CLI::Option* option_;
};

/// A command or subcommand. What options are read into must live as long as the program.
class Command {
 public:
  Command subcommand(const std::string& name, const std::string& description);

  /// `name`: "--name", or "NAME" for a positional.
  Option option(const std::string& name, std::string& value, const std::string& help);
  Option option(const std::string& name, std::vector<std::string>& value, const std::string& help);
  Option option(const std::string& name, int& value, const std::string& help);
  Option option(const std::string& name, std::optional<std::int64_t>& value,
                const std::string& help);
  Option option(const std::string& name, std::optional<double>& value, const std::string& help);
  Option option(const std::string& name, std::uint64_t& value, const std::string& help);
  Option option(const std::string& name, double& value, const std::string& help);
  Option option(const std::string& name, const std::function<void(const std::string&)>& take,
                const std::string& help);
  void flag(const std::string& name, bool& value, const std::string& help);

  void footer(const std::string& text);
  void callback(const std::function<void()>& work);
  /// The command knows no option, not even --help: `work` takes all words that follow it.
  void take_words(const std::function<void(const std::vector<std::string>&)>& work);

 protected:
  explicit Command(CLI::App* app) : app_(app) {}
  CLI::App* app_;
};

/// A whole program.
class Program : public Command {
 public:
  Program(const std::string& name, const std::string& description);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void version(const std::string& text);  ///< what --version prints
  /// Takes one subcommand at most; without one the help is printed.
  void helps_without_subcommand();
  /// Parses the command line and runs what it asks for. Returns the exit code: 0 done, 2 for wrong
  /// use, 1 for any other failure, whose message goes to standard error.
  int run(int argc, char** argv);

 private:
  std::unique_ptr<CLI::App> owned_;
};

}  // namespace glint::cli
