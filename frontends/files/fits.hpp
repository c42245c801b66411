// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>

#include "glint/engine/scheduler.hpp"

namespace glint {

/// A FITS file's first image (NAXIS 2) or cube (NAXIS 3, frames along the third axis), compressed
/// ones included, as float with BSCALE and BZERO applied; BLANK pixels become NaN. Rows come in the
/// order of the file: y = 0 is the file's first row. Throws std::runtime_error that names the file.
std::unique_ptr<Source> open_fits(const std::string& path);

}  // namespace glint
