// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "glint/engine/frames/frame_preparer.hpp"
#include "glint/engine/frames/point_finder.hpp"
#include "glint/engine/settings.hpp"
#include "glint/engine/source.hpp"
#include "glint/engine/state/checkpoint.hpp"
#include "glint/engine/tracks/tracker.hpp"

namespace glint {

/// Lets the background learn the source's next frames, at most `frames`, before any is prepared.
/// Stops at a frame that is damaged: the run that comes to it says so.
void prime_background(FramePreparer& preparer, Source& source, int frames);

/// What a stage of the pipeline has cost so far.
struct StageTime {
  std::string stage;   ///< "read", "prepare", the trackers' names, "sinks"
  double seconds = 0;  ///< [s] of wall clock, its nested parallel work included
};

/// Reads, prepares, steps every tracker and feeds every sink: serial in-order stages of a pipeline
/// with a bounded number of frames in flight, inside the device's own arena. An exception of any
/// stage comes out here after all earlier frames were delivered to the sinks; later frames are not
/// delivered. What the sinks get, and the logs of a run without an exception, never depend on the
/// threads; after one, a log may hold points of frames that were then in flight.
class Scheduler {
 public:
  static constexpr std::size_t kFramesInFlight = 4;

  /// Trackers by name, with settings, as Engine takes them.
  explicit Scheduler(std::string_view trackers, const Settings& settings = {});
  /// `points`: how points are found for trackers that feed on them.
  Scheduler(const Device& device, FramePreparer preparer, const PointsConfig& points = {});
  ~Scheduler();
  Scheduler(Scheduler&&) noexcept;

  void add(std::unique_ptr<Tracker> tracker, std::string name = "tracker");
  /// Sinks get each scan in the order in which they were added.
  void add(Sink& sink);
  /// Scans get their points even if no tracker feeds on them.
  void find_points();
  /// Runs to the end of the source, or until `stop` is requested: then no more frames are read,
  /// those in flight are finished, and those that prime() holds are dropped. Calls every tracker's
  /// finish() but that of one which threw. Returns the number of frames delivered. Runs once;
  /// throws std::logic_error if called again.
  std::int64_t run(Source& source, const std::stop_token& stop = {});
  /// The two parts of run(), for a source that may have more later: to the end of what it has now,
  /// as often as need be; then finish(), once, which tracks what prime() still holds. Each throws
  /// what any stage has thrown so far.
  void advance(Source& source, const std::stop_token& stop = {});
  void finish();

  const std::vector<const TrackLog*>& logs() const;  ///< one a tracker, in their order
  /// Logs hold the last `frames` frames alone, for streams without an end; late corrections of
  /// earlier ones are lost. 0, the default: all.
  void keep(std::int64_t frames);
  /// The background is learned from the first `frames` frames before the first is tracked: they are
  /// held in memory until so many came, or the source's end, or release_primed(). Call it before
  /// the first frame.
  void prime(std::int64_t frames);
  /// Frames are held by prime() that could go on.
  bool holds_frames() const;
  /// The next advance() learns from the frames that are held by now, and holds no more.
  void release_primed();
  /// Room for that many points in every log, so that reporting them allocates nothing.
  void reserve(std::size_t points);
  const Tracker& tracker(std::size_t i) const;
  const FramePreparer& preparer() const;
  std::int64_t frames() const;  ///< delivered so far, also after an exception
  std::vector<StageTime> stage_times() const;

  /// What results depend on besides the frames, as TOML: a checkpoint goes on only under the same.
  /// Without it a checkpoint tells no other settings or seed from these.
  void set_settings(std::string toml);
  /// Everything that later frames depend on, the logs included, between two advance(), before
  /// finish(). Throws std::logic_error after it, and what any stage has thrown so far.
  std::string checkpoint() const;
  /// Goes on from a checkpoint() of a Scheduler with the same trackers, settings and kind of device
  /// instead of from the first frame: logs and results become those of a run that never stopped,
  /// byte by byte, on any number of threads. Throws std::logic_error if frames came in already, and
  /// CheckpointError for bytes that are damaged or do not fit; make another Scheduler then.
  void restore(std::string_view checkpoint);

 private:
  friend class Engine;
  void drop_held();
  void put_state(ByteWriter& to) const;
  enum class After { nothing, more };  ///< what may follow the state
  void take_state(ByteReader& from, After after);
  CheckpointLabel label(std::string maker) const;

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace glint
