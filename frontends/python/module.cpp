// SPDX-License-Identifier: Apache-2.0
// The extension module glint._glint. Users import the package glint, whose Python files say what
// each function takes.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>

#include "glint/engine/run_config.hpp"
#include "glint/engine/scenario/scenario.hpp"
#include "glint/engine/trackers/registry.hpp"
#include "glint/experiments/experiment.hpp"
#include "glint/frontends/config/toml.hpp"
#include "glint/frontends/python/engine.hpp"
#include "glint/frontends/python/studies.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint::python {
namespace {

using py::literals::operator""_a;

/// Name and summary of each entry.
template <class Entries>
py::dict summaries(const Entries& entries) {
  py::dict names;
  for (const auto& entry : entries) names[py::str(std::string(entry.name))] = entry.summary;
  return names;
}

std::string default_config(const std::optional<std::string>& trackers) {
  const std::vector<ConfigSection> all = all_sections();
  if (!trackers) return write_toml(all);
  RunConfig run;
  run.tracker = *trackers;
  return write_toml(used_sections(all, trackers_of(run)));
}

void add_errors(py::module_& m) {
  static py::exception<ConfigError> config_error(m, "ConfigError", PyExc_ValueError);
  py::register_exception<CheckpointError>(m, "CheckpointError", PyExc_ValueError);
  py::register_exception_translator(
      [](std::exception_ptr error) {  // NOLINT(performance-unnecessary-value-param)
        try {
          if (error) std::rethrow_exception(error);
        } catch (const ConfigError& e) {
          config_error(e.what());
        } catch (const UsageError& e) {
          config_error(e.what());
        }
      });
}

void add_engine(py::module_& m) {
  py::class_<Result>(m, "Result", "The tracks of a frame as they were known when it was done.")
      .def_readonly("frame", &Result::frame, "Number of the push, from 0, dropped ones counted.")
      .def_readonly("time", &Result::time, "As given to push() [s].")
      .def_readonly("latency", &Result::latency, "From the push to the result [s].")
      .def_readonly("tracks", &Result::tracks,
                    "Structured array, by tracker, then by track_id; see glint.TRACK.");
  const auto new_engine = [](std::optional<std::string> profile, std::string config_text,
                             Values config, std::optional<std::string> trackers, Values settings,
                             std::size_t queue, const std::string& when_full) {
    return std::make_unique<PushEngine>(
        Request{std::move(profile), std::move(config_text), std::move(config), std::move(trackers),
                std::move(settings)},
        queue, when_full);
  };
  py::class_<PushEngine>(m, "Engine")
      .def(py::init(new_engine), "profile"_a, "config_text"_a, "config"_a, "trackers"_a,
           "settings"_a, "queue"_a, "when_full"_a)
      .def("push", py::overload_cast<const py::object&, double, bool>(&PushEngine::push), "frame"_a,
           "time"_a, py::kw_only(), "copy"_a = false,
           "Queue a frame, taken at `time` [s].\n\n"
           "`frame` is uint8, uint16 or float32 of shape (height, width), or with a third axis of\n"
           "3 (BGR) or 4 (BGRA). Its pixels are read where they are, later and on other threads:\n"
           "leave them as they are until drain() returns, or give `copy=True`. Rows may lie any\n"
           "distance apart; only where they are not aligned to their pixels are they copied.\n"
           "Returns False if a frame that waited was dropped for this one, else True. Raises\n"
           "TypeError and ValueError for an array that cannot be taken, RuntimeError after\n"
           "finish(), and what ended the engine if something did.")
      .def("push_points", &PushEngine::push_points, "points"_a, "time"_a,
           "Queue the points of a scan without a frame, for trackers of points.\n\n"
           "`points` has the shape (n, 2) for x, y or (n, 3) for x, y, amplitude, and is taken as\n"
           "float64: x and y [px], or in any unit of length that the settings share. All pushes\n"
           "of an engine are of one kind. Returns and raises as push() does.")
      .def(
          "start", &PushEngine::start, "x"_a, "y"_a, "vx"_a = py::none(), "vy"_a = py::none(),
          "sigma"_a = py::none(),
          "Somebody's word for a target at x, y [px] in the frame that is pushed next.\n\n"
          "Every tracker starts a confirmed track there. `vx`, `vy` [px/s] are its velocity if it\n"
          "is known (before the first frame it does not count), `sigma` the standard deviation of\n"
          "x and of y [px]; without it the tracker takes its own. A target that has a track gets\n"
          "no second one; outside the frame none starts. Raises ValueError for numbers that "
          "cannot\n"
          "be, RuntimeError after finish(), and what ended the engine.")
      .def(
          "poll", &PushEngine::poll, "timeout"_a = 0.0,
          "The Result of the next frame that is done, in order, waited for at most `timeout` [s],\n"
          "or None if there is none by then. Raises what ended the engine once the results before\n"
          "it were given.")
      .def("_next", &PushEngine::next)
      .def(
          "checkpoint", [](PushEngine& engine) { return py::bytes(engine.checkpoint()); },
          "All that later frames depend on, and the tracks so far, as bytes.\n\n"
          "Frames that were pushed are tracked first; results that wait to be polled come along.\n"
          "Raises RuntimeError after finish(), and what ended the engine.")
      .def(
          "restore",
          [](PushEngine& engine, const py::bytes& checkpoint) { engine.restore(checkpoint); },
          "checkpoint"_a,
          "Before the first push: go on from the checkpoint of an engine with the same settings,\n"
          "as if it had never stopped. Raises CheckpointError (a ValueError) for one that is\n"
          "damaged or of other settings, another version or kind of device: make another engine\n"
          "then. Raises RuntimeError after a push.")
      .def("drain", &PushEngine::drain,
           "Wait until every frame that was pushed is done. Raises what ended the engine.")
      .def("finish", &PushEngine::finish,
           "Drain, and let the trackers say what they still hold; no frame can be pushed after "
           "that.")
      .def("reported", &PushEngine::reported,
           "After finish(): all tracks of all frames as reported at the time, those said late "
           "included.")
      .def("revised", &PushEngine::revised,
           "After finish(): all tracks of all frames as they were revised later.")
      .def_property_readonly("pushed", &PushEngine::pushed, "Frames pushed, dropped ones counted.")
      .def_property_readonly("dropped", &PushEngine::dropped, "Frames dropped.");
}

void add_studies(py::module_& m) {
  m.def("simulate", &simulate, "scene"_a, "seed"_a, "settings"_a);
  m.def(
      "evaluate",
      [](const TrackArray& tracks, const TruthArray& truth, double cutoff, double order,
         bool include_tentative, std::optional<std::int64_t> frames) {
        return evaluate_rows(tracks, truth, {cutoff, order, include_tentative, frames});
      },
      "tracks"_a, "truth"_a, "cutoff"_a, "order"_a, "include_tentative"_a, "frames"_a);
  m.def("experiment", &run_named_experiment, "name"_a, "runs"_a, "seed"_a, "threads"_a);
}

void add_lists(py::module_& m) {
  m.def("trackers", [] { return summaries(all_trackers()); });
  m.def("scenes", [] { return summaries(all_scenes()); });
  m.def("experiments", [] { return summaries(all_experiments()); });
  m.def("default_config", &default_config, "trackers"_a);
  m.attr("TRACK") = py::dtype::of<glint_track>();
  m.attr("TRUTH") = py::dtype::of<TruthPoint>();
  m.attr("version") = GLINT_VERSION;
}

}  // namespace

PYBIND11_MODULE(_glint, m) {
  m.doc() = "What the package glint stands on.";
  register_rows();
  add_errors(m);
  add_engine(m);
  add_studies(m);
  add_lists(m);
}

}  // namespace glint::python
