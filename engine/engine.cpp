// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/engine.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>
#include <variant>

#include "glint/engine/run_config.hpp"
#include "glint/engine/state/fields.hpp"

namespace glint {

/// Hands out what waits now; a run over it ends when nothing does.
class Engine::Queue : public Source {
 public:
  explicit Queue(Engine& engine) : engine_(engine) {}
  std::optional<SourceFrame> next() override {
    std::unique_lock lock(engine_.mutex_);
    if (engine_.waiting_.empty() || engine_.abandoned_) return std::nullopt;
    Waiting first = std::move(engine_.waiting_.front());
    engine_.waiting_.pop_front();
    engine_.at_work_.push_back(first.pushed);
    const bool room = engine_.full_ && engine_.waiting_.size() <= engine_.settings_.queue * 3 / 4;
    if (room) engine_.full_ = false;
    lock.unlock();
    if (room) engine_.room_.notify_all();
    return std::move(first.frame);
  }

 private:
  Engine& engine_;
};

/// Frames come out in the order in which they went in.
class Engine::Results : public Sink {
 public:
  explicit Results(Engine& engine) : engine_(engine) {}
  void take(const ScanResult& scan) override {
    EngineResult result{scan.scan.frame, scan.scan.time, 0, {}};
    for (std::size_t i = 0; i < scan.reported.size(); ++i) {
      for (const TrackPoint& point : scan.reported[i]) {
        result.tracks.push_back({point, static_cast<int>(i)});
      }
    }
    {
      const std::scoped_lock lock(engine_.mutex_);
      result.latency =
          std::chrono::duration<double>(Clock::now() - engine_.at_work_.front()).count();
      engine_.at_work_.pop_front();
    }
    if (engine_.settings_.on_result) engine_.settings_.on_result(result);
    {
      const std::scoped_lock lock(engine_.mutex_);
      if (!engine_.settings_.on_result) engine_.results_.push_back(std::move(result));
      ++engine_.settled_;
    }
    engine_.settled_or_idle_.notify_all();
  }

 private:
  Engine& engine_;
};

Engine::Engine(std::string_view trackers, const Settings& settings, EngineSettings of_engine)
    : Engine(scheduler_of(trackers, settings), std::move(of_engine)) {}

Engine::Engine(Scheduler scheduler, EngineSettings settings)
    : scheduler_(std::move(scheduler)),
      settings_(std::move(settings)),
      source_(std::make_unique<Queue>(*this)),
      sink_(std::make_unique<Results>(*this)) {
  if (settings_.queue == 0) throw std::invalid_argument("an engine's queue holds at least a frame");
  scheduler_.add(*sink_);
  thread_ = std::thread([this] { work(); });
}

Engine::~Engine() {
  {
    const std::scoped_lock lock(mutex_);
    abandoned_ = true;
    stop_.request_stop();
  }
  close();
  if (thread_.joinable()) thread_.join();
}

void Engine::work() {
  std::exception_ptr error;
  const auto attempt = [&error](const auto& part) {
    try {
      part();
    } catch (...) {
      if (!error) error = std::current_exception();
    }
  };
  attempt([&] {
    while (wait_for_frames()) {
      scheduler_.advance(*source_, stop_.get_token());
      const std::scoped_lock lock(mutex_);
      holds_ = scheduler_.holds_frames();
    }
  });
  attempt([&] { scheduler_.finish(); });  // of what was tracked before a failure as well
  const std::scoped_lock lock(mutex_);
  if (!error_) error_ = error;  // a restore() that failed comes first
  ended_ = true;
  waiting_.clear();
  room_.notify_all(), settled_or_idle_.notify_all();
}

/// False at the end. Frames that are held for the background go on when somebody waits for them.
bool Engine::wait_for_frames() {
  std::unique_lock lock(mutex_);
  const auto hurried = [&] { return holds_ && hurries_ > 0; };
  idle_ = true;
  settled_or_idle_.notify_all();
  frames_.wait(lock, [&] { return !waiting_.empty() || closed_ || hurried(); });
  idle_ = false;
  if (abandoned_) scheduler_.drop_held();
  if (hurried() && waiting_.empty()) scheduler_.release_primed();
  return (!waiting_.empty() || hurried()) && !abandoned_;
}

bool Engine::push(const RawPixels& pixels, double time) {
  SourceFrame frame;
  frame.pixels = pixels, frame.time = time;
  own_pixels(frame);
  return push(std::move(frame));
}

bool Engine::push(SourceFrame frame) {
  if (!frame.points || frame.pixels.width > 0) frame.pixels = checked(frame.pixels);
  std::unique_lock lock(mutex_);
  const bool waits = settings_.when_full == EngineSettings::WhenFull::wait;
  room_.wait(lock, [&] { return ended_ || closed_ || (checkpoints_ == 0 && !(waits && full_)); });
  rethrow();
  if (closed_) throw std::logic_error("push() after finish(): make another engine");
  frame.cues.insert(frame.cues.end(), cues_.begin(), cues_.end());
  cues_.clear();
  bool kept = true;
  while (waiting_.size() >= settings_.queue) {
    // The frame behind it comes later than one that was not lost would.
    const std::int64_t lost = waiting_.front().frame.skipped + 1;
    std::vector<Cue> cues = std::move(waiting_.front().frame.cues);
    const double time = waiting_.front().frame.time;
    waiting_.pop_front();
    SourceFrame& next = waiting_.empty() ? frame : waiting_.front().frame;
    next.skipped += lost;
    move_on(cues, next.time - time);
    next.cues.insert(next.cues.begin(), cues.begin(), cues.end());
    ++dropped_, ++settled_;
    kept = false;
  }
  waiting_.push_back({std::move(frame), Clock::now()});
  full_ = waiting_.size() >= settings_.queue;
  ++pushed_;
  lock.unlock();
  frames_.notify_one();
  if (!kept) settled_or_idle_.notify_all();
  return kept;
}

void Engine::start(double x, double y, double vx, double vy, double sigma) {
  const Cue cue = checked(Cue{x, y, vx, vy, sigma});
  const std::scoped_lock lock(mutex_);
  rethrow();
  if (closed_) throw std::logic_error("start() after finish(): make another engine");
  cues_.push_back(cue);
}

/// With mutex_ locked.
std::optional<EngineResult> Engine::take_result() {
  if (results_.empty()) return std::nullopt;
  std::optional<EngineResult> result = std::move(results_.front());
  results_.pop_front();
  return result;
}

std::optional<EngineResult> Engine::poll(std::chrono::duration<double> timeout,
                                         const std::function<bool(const EngineResult&)>& wants) {
  std::unique_lock lock(mutex_);
  constexpr std::chrono::duration<double> kLongest(1e9);  // a longer one overflows the clock
  if (timeout.count() > 0) {
    settled_or_idle_.wait_for(lock, std::min(timeout, kLongest),
                              [&] { return !results_.empty() || ended_ || error_; });
  }
  if (results_.empty()) rethrow();
  if (results_.empty() || (wants && !wants(results_.front()))) return std::nullopt;
  return take_result();
}

bool Engine::more() const {
  const std::scoped_lock lock(mutex_);
  return !results_.empty() || !(ended_ || error_);
}

/// Of the frames pushed by now; nothing once all of theirs were given.
std::optional<EngineResult> Engine::next_result() {
  std::unique_lock lock(mutex_);
  ++hurries_;
  frames_.notify_one();
  settled_or_idle_.wait(lock, [&] { return !results_.empty() || ended_ || settled_ >= pushed_; });
  --hurries_;
  if (results_.empty()) rethrow();
  return take_result();
}

std::string Engine::checkpoint() {
  std::unique_lock lock(mutex_);
  ++checkpoints_;
  settled_or_idle_.wait(lock, [&] { return ended_ || (idle_ && waiting_.empty()); });
  --checkpoints_;
  room_.notify_all();  // whoever is woken waits for the lock
  rethrow();
  if (closed_) throw std::logic_error("a finished engine has no checkpoint: take it before");
  if (holds_) {
    throw std::logic_error(
        "frames are held until the background is learned (frames.background_prime): take the "
        "checkpoint when the first result came");
  }
  ByteWriter to = begin_checkpoint(scheduler_.label("Engine"));
  scheduler_.put_state(to);
  put_bytes(to, pushed_), put_bytes(to, dropped_), put_bytes(to, results_);
  put_bytes(to, cues_);
  return seal_checkpoint(std::move(to));
}

void Engine::take_state(ByteReader& from) {
  scheduler_.take_state(from, Scheduler::After::more);
  std::int64_t pushed = 0, dropped = 0;
  std::deque<EngineResult> results;
  std::vector<Cue> cues;
  take_bytes(from, pushed), take_bytes(from, dropped), take_bytes(from, results);
  take_bytes(from, cues);
  require_bytes(from.left() == 0, "it is too long");
  require_frame_number(pushed);
  require_bytes(dropped >= 0 && dropped <= pushed, "the counts of frames do not fit");
  const auto trackers = static_cast<int>(scheduler_.logs().size());
  for (const EngineResult& result : results) {
    for (const Track& track : result.tracks) {
      require_bytes(track.tracker >= 0 && track.tracker < trackers,
                    "a result is not of these trackers");
    }
  }
  pushed_ = settled_ = pushed, dropped_ = dropped, results_ = std::move(results);
  cues_ = std::move(cues);
}

void Engine::restore(std::string_view checkpoint) {
  const std::scoped_lock lock(mutex_);
  rethrow();
  if (pushed_ > 0 || closed_) throw std::logic_error("restore() before the first push()");
  OpenCheckpoint open = open_checkpoint(checkpoint);
  require_same(open.label, scheduler_.label("Engine"));
  try {
    refuse_damaged([&] { take_state(open.state); });
  } catch (...) {
    error_ = std::current_exception();
    throw;
  }
}

void Engine::drain() {
  std::unique_lock lock(mutex_);
  const std::int64_t goal = pushed_;
  ++hurries_;
  frames_.notify_one();
  settled_or_idle_.wait(lock, [&] { return ended_ || error_ || settled_ >= goal; });
  --hurries_;
  rethrow();
}

void Engine::finish() {
  close();
  std::unique_lock lock(mutex_);
  settled_or_idle_.wait(lock, [&] { return ended_; });
  rethrow();
}

void Engine::close() {
  const std::scoped_lock lock(mutex_);
  closed_ = true;
  room_.notify_all(), frames_.notify_all();
}

void Engine::rethrow() const {
  if (error_) std::rethrow_exception(error_);
}

std::int64_t Engine::pushed() const {
  const std::scoped_lock lock(mutex_);
  return pushed_;
}

std::int64_t Engine::dropped() const {
  const std::scoped_lock lock(mutex_);
  return dropped_;
}

}  // namespace glint
