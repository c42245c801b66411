// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <sys/types.h>

#include <cstddef>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace glint::bench {

/// Another program, which reads its standard input from here and may be asked for its output.
class Child {
 public:
  enum class Output { read, dropped };
  /// Starts `command`, found as a shell finds it; what it says on standard error is dropped. Throws
  /// std::system_error if it cannot be started.
  Child(const std::vector<std::string>& command, Output output);
  /// Ends its input and waits for it.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Throws std::runtime_error if it reads no more.
  void write(std::span<const std::byte> bytes);
  /// Its next line without the end; nothing if there are no more.
  std::optional<std::string> line();
  /// Ends its input, waits for it and returns its exit code, or 128 and the signal that ended it.
  int wait();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  using File = std::unique_ptr<std::FILE, Close>;
  File in_, out_;
  pid_t pid_ = 0;
  std::string name_;
};

}  // namespace glint::bench
