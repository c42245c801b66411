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

}  // namespace glint::cli
