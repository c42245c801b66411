// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/modules/fits.hpp"

extern "C" const void* glint_module() {
  static constexpr glint::FitsFunctions kFunctions{.open_fits = glint::open_fits};
  return &kFunctions;
}
