// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/embed/child.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace glint::bench {
namespace {

struct Pipe {
  Pipe() {
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
      throw std::system_error(errno, std::generic_category(), "no pipe to another program");
    }
  }
  ~Pipe() {
    for (const int end : ends) {
      if (end >= 0) close(end);
    }
  }
  std::FILE* take(int end, const char* mode) {
    return fdopen(std::exchange(ends[static_cast<std::size_t>(end)], -1), mode);
  }
  std::array<int, 2> ends{-1, -1};  // to read from, to write to
};

}  // namespace

Child::Child(const std::vector<std::string>& command, Output output) : name_(command.front()) {
  // A program that has ended is an error of write(), not the end of this one.
  std::signal(SIGPIPE, SIG_IGN);
  Pipe in, out;
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, in.ends[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  if (output == Output::read) {
    posix_spawn_file_actions_adddup2(&files, out.ends[1], STDOUT_FILENO);
  } else {
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  }
  const int failed = posix_spawnp(&pid_, name_.c_str(), &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (failed != 0) {
    pid_ = 0;
    throw std::system_error(failed, std::generic_category(), name_ + " cannot be started");
  }
  in_.reset(in.take(1, "wb"));
  out_.reset(out.take(0, "rb"));
}

Child::~Child() { wait(); }

void Child::write(std::span<const std::byte> bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), in_.get()) != bytes.size() ||
      std::fflush(in_.get()) != 0) {
    throw std::runtime_error(name_ + " reads no more");
  }
}

std::optional<std::string> Child::line() {
  std::string text;
  for (int c = std::fgetc(out_.get()); c != EOF; c = std::fgetc(out_.get())) {
    if (c == '\n') return text;
    text.push_back(static_cast<char>(c));
  }
  return std::nullopt;
}

int Child::wait() {
  in_.reset();
  if (pid_ == 0) return 0;
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = 0;
  constexpr int kSignalled = 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status);
}

}  // namespace glint::bench
