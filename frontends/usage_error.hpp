// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <stdexcept>
#include <string>

namespace glint {

/// The caller asked for something that cannot be: a missing file, an output that cannot be written.
/// The message is one line and says what to do instead.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Takes a warning: one line, no "warning:" in front.
using Warn = std::function<void(const std::string&)>;

}  // namespace glint
