// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <stdexcept>

namespace glint {

/// A configuration mistake; the message names the key, what it must be, and what it was.
struct ConfigError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Bytes that do not hold what was to be read.
struct BytesError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A checkpoint that cannot be gone on from; the message says why.
struct CheckpointError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace glint
