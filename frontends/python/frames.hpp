// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/numpy.h>

#include <memory>
#include <mutex>
#include <vector>

#include "glint/engine/scheduler.hpp"

namespace glint::python {

namespace py = pybind11;

/// Python objects whose pixels are being read. A thread of the engine that is done with one only
/// puts it here: it never waits for the GIL, so that neither Python code that runs for long holds
/// the engine up, nor an interpreter that ends is entered.
class Lent : public std::enable_shared_from_this<Lent> {
 public:
  /// Keeps `object` alive until the last copy of the owner is gone and let_go() was called.
  std::shared_ptr<const void> lend(py::object object);
  /// Drops the references to what nobody reads any more. The GIL must be held.
  void let_go();

 private:
  std::mutex mutex_;
  std::vector<PyObject*> done_;
};

/// The pixels where they are, but for rows that are not aligned to their pixels, and with `copy`:
/// those are copied. Throws TypeError and ValueError that name the remedy.
SourceFrame frame_of(const py::object& given, double time, bool copy, Lent& lent);

/// A scan of points, `given` of shape (n, 2): x, y, or (n, 3): x, y, amplitude. Throws as above.
SourceFrame points_of(const py::object& given, double time);

}  // namespace glint::python
