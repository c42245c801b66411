// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/numpy.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "glint/engine/engine.hpp"
#include "glint/frontends/python/frames.hpp"
#include "glint/frontends/python/settings.hpp"
#include "glint/frontends/python/tables.hpp"

namespace glint::python {

/// An EngineResult with its tracks as rows.
struct Result {
  std::int64_t frame;
  double time, latency;  ///< [s]
  TrackArray tracks;
};

/// Engine for Python: every call gives the GIL away for as long as it is in the engine.
class PushEngine {
 public:
  PushEngine(const Request& request, std::size_t queue, const std::string& when_full);
  ~PushEngine();  // NOLINT(bugprone-exception-escape): only a broken mutex or GIL would throw
  PushEngine(const PushEngine&) = delete;
  PushEngine& operator=(const PushEngine&) = delete;

  bool push(const py::object& frame, double time, bool copy);
  void start(double x, double y, std::optional<double> vx, std::optional<double> vy,
             std::optional<double> sigma);
  bool push_points(const py::object& points, double time);
  std::optional<Result> poll(double timeout);  ///< [s]
  /// Of the frames pushed by now, waited for; nothing once all of theirs were given.
  std::optional<Result> next();
  std::string checkpoint();
  void restore(const std::string& checkpoint);
  void drain();
  void finish();
  TrackArray reported();
  TrackArray revised();
  std::int64_t pushed();
  std::int64_t dropped();

 private:
  template <class Work>
  auto in_engine(const Work& work);
  bool push(SourceFrame frame);
  TrackArray whole_logs(std::vector<TrackPoint> (TrackLog::*record)() const);

  std::shared_ptr<Lent> lent_ = std::make_shared<Lent>();
  std::optional<std::pair<int, int>> size_;  // height, width of the first frame [px]
  bool finished_ = false;
  std::unique_ptr<Engine> engine_;
};

}  // namespace glint::python
