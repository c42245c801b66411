// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/frontends/files/fits.hpp"

namespace glint {

/// What is done with CFITSIO.
struct FitsFunctions {
  decltype(&glint::open_fits) open_fits;
};

/// The module of these functions, opened by the first call. Throws as open_module() does.
const FitsFunctions& fits();

}  // namespace glint
