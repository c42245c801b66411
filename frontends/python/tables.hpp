// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/numpy.h>

#include <cstdint>
#include <span>
#include <vector>

#include "glint/engine/engine.hpp"
#include "glint/engine/scenario/truth.hpp"
#include "glint/engine/tracks/track_log.hpp"
#include "glint/frontends/capi/glint.h"

namespace glint::python {

namespace py = pybind11;

using TrackArray = py::array_t<glint_track>;
using TruthArray = py::array_t<TruthPoint>;

/// A copy of a list.
template <class T>
py::array_t<T> array_of(const std::vector<T>& values) {
  return py::array_t<T>(static_cast<py::ssize_t>(values.size()), values.data());
}

/// Tells NumPy what the rows look like; before any array of them is made.
void register_rows();

/// The trackers' points, one list a tracker, as rows in that order.
TrackArray track_array(std::span<const std::vector<TrackPoint>> trackers);
TrackArray track_array(std::span<const Track> tracks);
TruthArray truth_array(const std::vector<TruthPoint>& truth);

std::vector<TrackPoint> track_points(const TrackArray& rows);
std::vector<TruthPoint> truth_points(const TruthArray& rows);

}  // namespace glint::python
