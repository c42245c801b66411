// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/python/frames.hpp"

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>
#include <utility>

#include "glint/kernels/core/cells.hpp"

namespace glint::python {
namespace {

std::string text_of(const py::handle& object) { return py::str(object).cast<std::string>(); }

std::string shape_of(const py::array& array) { return text_of(array.attr("shape")); }

/// The type of a pixel by kind and size; foreign byte orders are none.
enum class Pixel { gray8, gray16, float32 };

Pixel pixel_of(const py::array& array) {
  const py::dtype type = array.dtype();
  const bool native = type.attr("isnative").cast<bool>();
  if (native && type.kind() == 'u' && type.itemsize() == 1) return Pixel::gray8;
  if (native && type.kind() == 'u' && type.itemsize() == 2) return Pixel::gray16;
  if (native && type.kind() == 'f' && type.itemsize() == 4) return Pixel::float32;
  const bool wide = type.kind() == 'u' && type.itemsize() == 2;
  throw py::type_error(
      "a frame must be uint8, uint16 or float32 in the machine's byte order, got " + text_of(type) +
      ": use frame.astype(numpy." + (wide ? "uint16)" : "float32)"));
}

void check_shape(const py::array& array) {
  const bool colour = array.ndim() == 3 && (array.shape(2) == 3 || array.shape(2) == 4);
  if (array.ndim() != 2 && !colour) {
    throw py::value_error(
        "a frame must have the shape (height, width), or (height, width, 3) for BGR and (height, "
        "width, 4) for BGRA, got " +
        shape_of(array) + ": push the frames of a stack one by one, frame[0], frame[1], ...");
  }
  if (array.shape(0) < 1 || array.shape(1) < 1) {
    throw py::value_error("a frame must have at least one pixel, got the shape " + shape_of(array));
  }
  if (array.shape(0) > kMaxSide || array.shape(1) > kMaxSide) {
    throw py::value_error("a frame may have at most " + std::to_string(kMaxSide) +
                          " pixels a side, got the shape " + shape_of(array) + ": crop it");
  }
}

/// What lies from one entry of an axis to the next; of a single entry nothing is said.
bool has_stride(const py::array& array, py::ssize_t axis, py::ssize_t bytes) {
  return array.shape(axis) == 1 || array.strides(axis) == bytes;
}

void check_strides(const py::array& array) {
  const py::ssize_t channels = array.ndim() == 3 ? array.shape(2) : 1;
  if (has_stride(array, 1, channels * array.itemsize()) &&
      (array.ndim() == 2 || has_stride(array, 2, array.itemsize()))) {
    return;
  }
  throw py::value_error("the pixels of a row must lie side by side in memory, got the strides " +
                        text_of(array.attr("strides")) + " for " + text_of(array.dtype()) +
                        ": use numpy.ascontiguousarray(frame); rows may lie any distance apart");
}

/// Whether pixels are aligned, and rows do not overlap as those of a broadcast array do.
bool can_be_lent(const py::array& array) {
  const auto address = reinterpret_cast<std::uintptr_t>(array.data());
  const py::ssize_t row = array.nbytes() / array.shape(0);
  return address % static_cast<std::uintptr_t>(array.itemsize()) == 0 &&
         array.strides(0) % array.itemsize() == 0 && std::abs(array.strides(0)) >= row;
}

decltype(RawPixels::data) data_of(const py::array& array, Pixel pixel) {
  if (pixel == Pixel::gray8) return static_cast<const std::uint8_t*>(array.data());
  if (pixel == Pixel::gray16) return static_cast<const std::uint16_t*>(array.data());
  return static_cast<const float*>(array.data());
}

}  // namespace

std::shared_ptr<const void> Lent::lend(py::object object) {
  return {object.release().ptr(), [self = shared_from_this()](PyObject* lent) {
            const std::scoped_lock lock(self->mutex_);
            self->done_.push_back(lent);
          }};
}

void Lent::let_go() {
  std::vector<PyObject*> done;
  {
    const std::scoped_lock lock(mutex_);
    done.swap(done_);
  }
  // Outside of the lock: the last reference may run code of the object's own.
  for (PyObject* object : done) Py_DECREF(object);
}

SourceFrame frame_of(const py::object& given, double time, bool copy, Lent& lent) {
  if (!py::isinstance<py::array>(given)) {
    throw py::type_error("a frame must be a numpy array, got " +
                         text_of(py::type::of(given).attr("__name__")) +
                         ": use numpy.asarray(frame) and choose uint8, uint16 or float32");
  }
  auto array = py::reinterpret_borrow<py::array>(given);
  const Pixel pixel = pixel_of(array);
  check_shape(array);
  check_strides(array);
  if (copy || !can_be_lent(array)) array = array.attr("copy")();
  const auto channels = array.ndim() == 3 ? static_cast<int>(array.shape(2)) : 1;
  SourceFrame frame;
  frame.time = time;
  frame.pixels = {data_of(array, pixel), static_cast<int>(array.shape(1)),
                  static_cast<int>(array.shape(0)), channels, array.strides(0) / array.itemsize()};
  frame.owner = lent.lend(std::move(array));
  return frame;
}

SourceFrame points_of(const py::object& given, double time) {
  const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(given);
  if (!array) {
    PyErr_Clear();
    throw py::type_error("points must be numbers, got " + text_of(given.get_type()) +
                         ": give an array of shape (n, 2) or (n, 3)");
  }
  if (array.ndim() != 2 || (array.shape(1) != 2 && array.shape(1) != 3)) {
    throw py::value_error(
        "points must have the shape (n, 2) for x, y or (n, 3) for x, y, amplitude, got " +
        shape_of(array) + ": for none give numpy.empty((0, 2))");
  }
  const auto values = array.unchecked<2>();
  SourceFrame scan;
  scan.time = time;
  scan.points.emplace();
  for (py::ssize_t i = 0; i < values.shape(0); ++i) {
    const double amplitude =
        values.shape(1) == 3 ? values(i, 2) : std::numeric_limits<double>::quiet_NaN();
    scan.points->push_back({values(i, 0), values(i, 1), amplitude});
  }
  return scan;
}

}  // namespace glint::python
