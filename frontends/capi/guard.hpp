// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>

#include "glint/engine/config.hpp"
#include "glint/engine/state/checkpoint.hpp"
#include "glint/frontends/capi/glint.h"
#include "glint/frontends/usage_error.hpp"

// How exceptions become the C interface's status codes.

namespace glint::capi {

/// What glint_last_error() gives.
inline thread_local std::string last_error;

/// What a call was given is not right.
struct BadArgument : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

inline void require(bool holds, const char* sentence) {
  if (!holds) throw BadArgument(sentence);
}

/// Runs work(), which gives a status; nothing is thrown beyond here.
template <class Work>
glint_status guarded(const Work& work) noexcept {
  const auto fail = [](glint_status status, const char* message) {
    try {
      last_error = message;
    } catch (...) {
      last_error.clear();
    }
    return status;
  };
  try {
    return work();
  } catch (const BadArgument& e) {
    return fail(GLINT_BAD_ARGUMENT, e.what());
  } catch (const CheckpointError& e) {
    return fail(GLINT_BAD_CHECKPOINT, e.what());
  } catch (const ConfigError& e) {
    return fail(GLINT_BAD_CONFIG, e.what());
  } catch (const UsageError& e) {
    return fail(GLINT_BAD_CONFIG, e.what());
  } catch (const std::invalid_argument& e) {
    return fail(GLINT_FAILED, e.what());
  } catch (const std::logic_error& e) {
    return fail(GLINT_BAD_STATE, e.what());
  } catch (const std::exception& e) {
    return fail(GLINT_FAILED, e.what());
  } catch (...) {
    return fail(GLINT_FAILED, "something that is no std::exception was thrown");
  }
}

/// The caller's struct as ours: fields that its header did not have yet keep their defaults.
template <class S>
S taken(const S* given, S defaults, const char* what) {
  require(given != nullptr, what);
  require(given->struct_size >= sizeof(size_t), "struct_size is 0: use the _INIT macro");
  std::memcpy(&defaults, given, std::min(given->struct_size, sizeof(S)));
  return defaults;
}

}  // namespace glint::capi
