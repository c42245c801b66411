// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/numpy.h>

#include <cstdint>
#include <string>

#include "glint/engine/metrics/evaluation.hpp"
#include "glint/frontends/python/settings.hpp"
#include "glint/frontends/python/tables.hpp"

namespace glint::python {

/// The scene's frames (float32, one after the other), their times and the truth. Throws
/// ConfigError.
py::tuple simulate(const std::string& name, std::uint64_t seed, const Values& settings);

/// The scores under the names of `glint evaluate --json`; None where undefined.
py::dict evaluate_rows(const TrackArray& tracks, const TruthArray& truth,
                       const EvaluationOptions& options);

/// A paper's experiment under the names of `glint experiment --json`, and its curves. Throws
/// ConfigError.
py::dict run_named_experiment(const std::string& name, int runs, std::uint64_t seed, int threads);

}  // namespace glint::python
