// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <stdexcept>

#include "glint/engine/config.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint::fuzz {

/// Calls f(). Bytes may be refused, with a message; anything else that f throws is a bug.
template <class F>
void or_refused(const F& f) {
  try {
    f();
  } catch (const UsageError&) {
  } catch (const ConfigError&) {
  } catch (const std::runtime_error&) {
  }
}

}  // namespace glint::fuzz
