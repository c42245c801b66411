// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <iterator>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <vector>

#include "glint/engine/scheduler.hpp"
#include "glint/engine/settings.hpp"

namespace glint {

/// A point of a track, and which tracker reported it.
struct Track : TrackPoint {
  int tracker = 0;  ///< index among the engine's trackers, in their order

  template <class Self>
  static auto fields(Self& s) {
    return std::tuple_cat(TrackPoint::fields(s), std::tie(s.tracker));
  }
};

/// The tracks of a frame as they were known when it was done.
struct EngineResult {
  std::int64_t frame = 0;     ///< number of the push(), from 0, dropped ones counted
  double time = 0;            ///< [s]
  double latency = 0;         ///< from push() to here [s]
  std::vector<Track> tracks;  ///< by tracker, then by track id

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.frame, s.time, s.latency, s.tracks);
  }
};

struct EngineSettings {
  enum class WhenFull {
    wait,         ///< once full push() waits for a quarter of it: every frame is tracked
    drop_oldest,  ///< the frame that has waited longest is dropped: what is tracked is recent
  };
  std::size_t queue = 8;  ///< frames that may wait, at least 1
  WhenFull when_full = WhenFull::wait;
  /// Gets every result, in order, one at a time, on a thread of the engine; it must not call the
  /// engine. What it throws ends the engine. Without it results wait for poll(), however many.
  std::function<void(const EngineResult&)> on_result;
};

/// Trackers that are fed frame by frame, for programs that have frames rather than a Source. Frames
/// are tracked on the device's threads while push() returns; engines made with copies of one Device
/// share its threads. What is tracked is a function of the frames, their times and which of them
/// were dropped. Every member may be called from any thread.
class Engine {
 public:
  /// `trackers`: a name, or several separated by spaces. `settings` are those of `glint config
  /// TRACKER`, the last part of a key alone where that is enough, and "profile". Throws
  /// ConfigError, with the nearest known key, for one that is unknown or has no effect, and for a
  /// bad value; std::runtime_error if the device cannot be opened.
  explicit Engine(std::string_view trackers, const Settings& settings = {},
                  EngineSettings of_engine = {});
  /// `scheduler` has its trackers; sinks may be added to it before.
  explicit Engine(Scheduler scheduler, EngineSettings settings = {});
  /// Frames that still wait are not tracked; those at work are finished.
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Copies the frame's pixels and queues it; `time` in [s]. Returns whether all frames found room:
  /// false if one was dropped for it. Throws std::logic_error after finish(), std::invalid_argument
  /// as checked() does for pixels, and what ended the engine if something did.
  bool push(const RawPixels& pixels, double time);
  /// The same without a copy: `frame.owner` is released, on any thread, once the pixels were read.
  /// Frames that hold points, alone or beside pixels, come in here too.
  bool push(SourceFrame frame);

  /// Somebody's word for a target at (x, y) [px] with velocity (vx, vy) [px/s] in the frame that is
  /// pushed next: every tracker starts a confirmed track there (docs/cues.md says what each makes
  /// of it). `sigma` is the standard deviation of x and of y [px], NaN what the tracker takes a
  /// position to err by: a point's own error, 2 px on frames. A velocity that is not given (NaN),
  /// or comes before the first frame, is looked for. A target that has a track gets no second one;
  /// outside the frame none starts. A cue in the first frames wants frames.background_prime: the
  /// background is not known there. Throws std::invalid_argument for other numbers,
  /// std::logic_error after finish(), and what ended the engine.
  void start(double x, double y, double vx = Cue::kUnknown, double vy = Cue::kUnknown,
             double sigma = Cue::kUnknown);

  /// The next result, waited for at most `timeout` [s]; nothing if there is none by then. One that
  /// `wants` (which must not call the engine) says no to stays the next one. Throws what ended the
  /// engine once the results before it were given.
  std::optional<EngineResult> poll(std::chrono::duration<double> timeout = {},
                                   const std::function<bool(const EngineResult&)>& wants = {});
  /// Whether more results may come: false once the engine has finished, or ended by an error, and
  /// every result was given.
  bool more() const;
  class ResultRange;
  /// The results of all frames that were pushed by now, waited for: for (const auto& result :
  /// engine.results()). After finish() it ends with the last frame's. Iterating throws what ended
  /// the engine once the results before it were given. Nothing with on_result.
  ResultRange results();
  /// Waits until every frame that was pushed is tracked. Throws what ended the engine. With
  /// frames.background_prime it ends the holding of frames, as results() does: the background is
  /// then learned from those that came.
  void drain();
  /// Drains, then lets the trackers report what they hold back, such as the last window of a batch;
  /// the logs are complete after that.
  /// Throws what ended the engine. A second call does nothing.
  void finish();

  /// Waits until every frame that was pushed is tracked, then gives everything that later frames
  /// depend on, the logs and the results that wait for poll() included; a push() meanwhile waits.
  /// Throws std::logic_error after finish() and while frames are held for frames.background_prime,
  /// and what ended the engine.
  std::string checkpoint();
  /// Before the first push(): goes on from the checkpoint() of an engine whose trackers, settings
  /// (Scheduler::set_settings()) and kind of device are the same, as if nothing had come between.
  /// Throws std::logic_error after a push(), and CheckpointError for bytes that are damaged or do
  /// not fit; make another engine then: this one has ended.
  void restore(std::string_view checkpoint);

  /// Tracks and notes; not to be looked into between a push() and the drain() or finish() after it.
  const Scheduler& scheduler() const { return scheduler_; }
  std::int64_t pushed() const;
  std::int64_t dropped() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Waiting {
    SourceFrame frame;
    Clock::time_point pushed;
  };
  class Queue;
  class Results;

  std::optional<EngineResult> take_result();
  std::optional<EngineResult> next_result();
  void work();
  void take_state(ByteReader& from);
  bool wait_for_frames();
  void close();
  void rethrow() const;

  Scheduler scheduler_;
  EngineSettings settings_;
  std::unique_ptr<Source> source_;
  std::unique_ptr<Sink> sink_;
  mutable std::mutex mutex_;
  // One for each kind of waiting, notified after the mutex is released where a frame passes: a
  // thread that wakes for nothing takes a core from the kernels.
  std::condition_variable room_;             // push() waits for it
  std::condition_variable frames_;           // thread_ waits for them
  std::condition_variable settled_or_idle_;  // drain(), finish() and checkpoint() wait for it
  std::deque<Waiting> waiting_;
  std::vector<Cue> cues_;                  // of the next frame
  std::deque<Clock::time_point> at_work_;  // when their frames were pushed
  std::deque<EngineResult> results_;
  std::int64_t pushed_ = 0, dropped_ = 0, settled_ = 0;  // settled_: tracked or dropped
  int checkpoints_ = 0;                                  // that wait for the frames at work
  int hurries_ = 0;     // who wait for all frames, those held for the background as well
  bool holds_ = false;  // scheduler_ holds frames until its background is learned
  bool full_ = false;   // until a quarter of the queue is free: one waking serves several frames
  bool idle_ = false;   // nothing touches scheduler_ until a frame waits
  bool closed_ = false, abandoned_ = false, ended_ = false;
  std::exception_ptr error_;
  std::stop_source stop_;  // of the frames that are held: requested when abandoned
  std::thread thread_;     // the last: it uses all of the above
};

/// What Engine::results() gives: a range to be gone through once.
class Engine::ResultRange {
 public:
  class Iterator {
   public:
    using value_type = EngineResult;
    using difference_type = std::ptrdiff_t;

    explicit Iterator(Engine& engine) : engine_(&engine), now_(engine.next_result()) {}
    const EngineResult& operator*() const { return *now_; }
    const EngineResult* operator->() const { return &*now_; }
    Iterator& operator++() {
      now_ = engine_->next_result();
      return *this;
    }
    void operator++(int) { ++*this; }
    bool operator==(std::default_sentinel_t) const { return !now_; }

   private:
    Engine* engine_;
    std::optional<EngineResult> now_;
  };

  explicit ResultRange(Engine& engine) : engine_(engine) {}
  Iterator begin() const { return Iterator(engine_); }
  std::default_sentinel_t end() const { return {}; }

 private:
  Engine& engine_;
};

inline Engine::ResultRange Engine::results() { return ResultRange(*this); }

}  // namespace glint
