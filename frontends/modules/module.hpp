// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace glint {

/// Opens a module, a part of the program in a shared object of its own, and returns the table of
/// its functions. What stands on OpenCV, CFITSIO or MPI is a module: these libraries and what they
/// need in turn are 250 files, which take longer to load than many commands run. A module is the
/// file
/// ../lib/glint/glint-NAME.so as seen from the program's folder, stays open to the end, and shows
/// nothing but the function glint_module(), which returns the table. Throws std::runtime_error that
/// names the file and the remedy if it cannot be opened.
const void* open_module(const std::string& name);

}  // namespace glint
