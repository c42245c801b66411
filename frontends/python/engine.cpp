// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/python/engine.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <stdexcept>
#include <string>

#include "glint/engine/run_config.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint::python {
namespace {

EngineSettings engine_settings(std::size_t queue, const std::string& when_full) {
  EngineSettings settings;
  settings.queue = queue;
  if (when_full == "drop_oldest") {
    settings.when_full = EngineSettings::WhenFull::drop_oldest;
  } else if (when_full != "wait") {
    throw py::value_error("when_full must be 'wait' or 'drop_oldest', got '" + when_full + "'");
  }
  return settings;
}

std::unique_ptr<Engine> make_engine(const Request& request, const EngineSettings& settings) {
  const py::gil_scoped_release release;
  try {
    return std::make_unique<Engine>(pushed_frames_scheduler(sections_of(request)), settings);
  } catch (const std::invalid_argument& e) {  // of settings that do not go together
    throw UsageError(e.what());
  }
}

std::string shape_text(const std::pair<int, int>& size) {
  return "(" + std::to_string(size.first) + ", " + std::to_string(size.second) + ")";
}

}  // namespace

PushEngine::PushEngine(const Request& request, std::size_t queue, const std::string& when_full)
    : engine_(make_engine(request, engine_settings(queue, when_full))) {}

PushEngine::~PushEngine() {  // NOLINT(bugprone-exception-escape): see there
  {
    const py::gil_scoped_release release;
    engine_.reset();
  }
  lent_->let_go();
}

/// Runs work() without the GIL, then drops the references to frames that were read.
template <class Work>
auto PushEngine::in_engine(const Work& work) {
  struct LetGo {
    ~LetGo() { lent.let_go(); }
    Lent& lent;
  } const let_go{*lent_};
  const py::gil_scoped_release release;  // destroyed first
  return work();
}

bool PushEngine::push(SourceFrame frame) {
  return in_engine([&] { return engine_->push(std::move(frame)); });
}

bool PushEngine::push(const py::object& frame, double time, bool copy) {
  SourceFrame source = frame_of(frame, time, copy, *lent_);
  const std::pair size(source.pixels.height, source.pixels.width);
  if (size_ && *size_ != size) {
    throw py::value_error("all frames of an engine have one size: the first had the shape " +
                          shape_text(*size_) + ", this one has " + shape_text(size) +
                          ": crop or pad it, or make another engine");
  }
  const bool kept = push(std::move(source));
  size_ = size;
  return kept;
}

void PushEngine::start(double x, double y, std::optional<double> vx, std::optional<double> vy,
                       std::optional<double> sigma) {
  in_engine([&] {
    engine_->start(x, y, vx.value_or(Cue::kUnknown), vy.value_or(Cue::kUnknown),
                   sigma.value_or(Cue::kUnknown));
  });
}

bool PushEngine::push_points(const py::object& points, double time) {
  return push(points_of(points, time));
}

namespace {

std::optional<Result> result_of(const std::optional<EngineResult>& result) {
  if (!result) return std::nullopt;
  return Result{result->frame, result->time, result->latency, track_array(result->tracks)};
}

}  // namespace

std::optional<Result> PushEngine::poll(double timeout) {
  // In slices, so that Ctrl-C is heard.
  constexpr double kSlice = 0.1;  // [s]
  for (;;) {
    const std::chrono::duration<double> slice(std::min(timeout, kSlice));
    auto result = in_engine([&] { return engine_->poll(slice); });
    timeout -= kSlice;
    if (result || timeout <= 0 || !engine_->more()) return result_of(result);
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

std::optional<Result> PushEngine::next() {
  return result_of(in_engine([&]() -> std::optional<EngineResult> {
    const auto first = engine_->results().begin();
    if (first == std::default_sentinel) return std::nullopt;
    return *first;
  }));
}

std::string PushEngine::checkpoint() {
  return in_engine([&] { return engine_->checkpoint(); });
}

void PushEngine::restore(const std::string& checkpoint) {
  in_engine([&] { engine_->restore(checkpoint); });
}

void PushEngine::drain() {
  in_engine([&] { engine_->drain(); });
}

void PushEngine::finish() {
  try {
    in_engine([&] { engine_->finish(); });
  } catch (...) {  // the engine has ended all the same: what was tracked so far can be had
    finished_ = true;
    throw;
  }
  finished_ = true;
}

TrackArray PushEngine::whole_logs(std::vector<TrackPoint> (TrackLog::*record)() const) {
  if (!finished_) throw std::runtime_error("tracks may still change: call finish() first");
  std::vector<std::vector<TrackPoint>> trackers;
  for (const TrackLog* log : engine_->scheduler().logs()) trackers.push_back((log->*record)());
  return track_array(trackers);
}

TrackArray PushEngine::reported() { return whole_logs(&TrackLog::online); }

TrackArray PushEngine::revised() { return whole_logs(&TrackLog::revised); }

std::int64_t PushEngine::pushed() {
  return in_engine([&] { return engine_->pushed(); });
}

std::int64_t PushEngine::dropped() {
  return in_engine([&] { return engine_->dropped(); });
}

}  // namespace glint::python
