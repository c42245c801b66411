// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <fmt/core.h>
#include <unistd.h>

#include <functional>

namespace glint::cli {

/// What shows "12 of 100 runs" on one line of a terminal; nothing elsewhere.
inline std::function<void(int done, int total)> run_progress() {
  if (isatty(STDERR_FILENO) == 0) return {};
  return [](int done, int total) {
    fmt::print(stderr, "\r{} of {} runs{}", done, total, done == total ? "\n" : "");
  };
}

/// The same in lines of their own, twenty in all: what a launcher passes on.
inline std::function<void(int done, int total)> progress_lines() {
  return [](int done, int total) {
    if (done * 20L / total > (done - 1) * 20L / total) {
      fmt::print(stderr, "{} of {} runs\n", done, total);
    }
  };
}

}  // namespace glint::cli
