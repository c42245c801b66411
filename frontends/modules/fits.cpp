// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/modules/fits.hpp"

#include "glint/frontends/modules/module.hpp"

namespace glint {

const FitsFunctions& fits() {
  static const auto* const table = static_cast<const FitsFunctions*>(open_module("fits"));
  return *table;
}

}  // namespace glint
