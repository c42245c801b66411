// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/scheduler.hpp"

#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <deque>
#include <exception>
#include <stdexcept>
#include <utility>

#include "glint/engine/held_frames.hpp"
#include "glint/engine/pipeline_stage.hpp"
#include "glint/engine/state/fields.hpp"

namespace glint {
namespace {

class NoMoreFrames : public Source {
 public:
  std::optional<SourceFrame> next() override { return std::nullopt; }
};

/// A tracker, its log and its stage.
struct TrackerStage {
  std::unique_ptr<Tracker> tracker;
  TrackLog log;
  Stage stage;
};

}  // namespace

void prime_background(FramePreparer& preparer, Source& source, int frames) {
  try {
    for (int i = 0; i < frames; ++i) {
      const auto frame = source.next();
      if (!frame) return;
      preparer.learn(frame->pixels);
    }
  } catch (const std::exception&) {
    return;
  }
}

struct Scheduler::State {
  State(const Device& on, FramePreparer with, const PointsConfig& points)
      : device(on), preparer(std::move(with)), finder(points, on) {}

  Token* read(Source& source, const std::stop_token& stop);
  void prepare(Token& token);
  void track(std::size_t i, Token& token);
  void deliver(Token& token);
  void run_serial(Source& source, const std::stop_token& stop);
  void run_pipeline(Source& source, const std::stop_token& stop);
  void advance(Source& source, const std::stop_token& stop);
  void finish();

  Device device;
  FramePreparer preparer;
  PointFinder finder;
  bool finds_points = false;
  std::deque<TrackerStage> trackers;
  std::vector<const TrackLog*> logs;
  std::vector<Sink*> sinks;
  Stage reading{"read"}, preparing{"prepare"}, delivering{"sinks"};
  // Frame f lives in tokens[f % kFramesInFlight]: frames leave in order, so the slot is free again
  // when the pipeline lets frame f + kFramesInFlight in.
  std::array<Token, kFramesInFlight> tokens;
  bool started = false, finished = false;
  std::int64_t read_count = 0, next_frame = 0, delivered = 0, kept = 0;
  HeldFrames held;
  std::atomic<bool> stopping = false;
  std::exception_ptr error;  // of the earliest frame that failed
  std::string settings;
};

Token* Scheduler::State::read(Source& source, const std::stop_token& stop) {
  if (stopping || stop.stop_requested()) return nullptr;
  Token& token = tokens[static_cast<std::size_t>(read_count) % kFramesInFlight];
  token.failed = false;
  token.error = nullptr;
  reading.pass(token, [&] { held.read(source, preparer, token.source); });
  if (token.source) next_frame += token.source->skipped;
  token.frame = next_frame;
  if (!token.failed && !token.source) return nullptr;
  if (token.failed) stopping = true;
  ++read_count, ++next_frame;
  return &token;
}

void Scheduler::State::prepare(Token& token) {
  preparing.pass(token, [&] {
    SourceFrame& source = *token.source;
    if (source.points && source.pixels.width == 0) {
      token.scan.frame = token.frame, token.scan.time = source.time;
    } else {
      token.scan = preparer.prepare(source.pixels, token.frame, source.time);
    }
    token.scan.sensor_x = source.sensor_x, token.scan.sensor_y = source.sensor_y;
    token.scan.looked = source.looked;
    if (source.points) {
      token.points = std::move(*source.points);
    } else if (finds_points) {
      finder.find(token.scan, token.points);
    }
    token.source.reset();
    if (finds_points) token.scan.points = token.points;
  });
  if (token.failed) stopping = true;
}

void Scheduler::State::track(std::size_t i, Token& token) {
  TrackerStage& entry = trackers[i];
  entry.stage.pass(token, [&] {
    if (token.scan.looked || entry.tracker->feed() != Feed::points) {
      entry.tracker->step(token.scan, entry.log);
    }
    entry.log.at(token.frame, token.reported[i]);
    if (kept > 0) entry.log.forget(token.frame - kept + 1);
  });
  if (token.failed) stopping = true;
}

void Scheduler::State::deliver(Token& token) {
  delivering.pass(token, [&] {
    for (Sink* sink : sinks) sink->take({token.scan, token.reported});
    ++delivered;
  });
  if (token.failed) stopping = true;
  if (token.error && !error) error = token.error;
  token.source.reset();
  token.scan = {};
}

void Scheduler::State::run_serial(Source& source, const std::stop_token& stop) {
  while (Token* token = read(source, stop)) {
    prepare(*token);
    for (std::size_t i = 0; i < trackers.size(); ++i) track(i, *token);
    deliver(*token);
  }
}

void Scheduler::State::run_pipeline(Source& source, const std::stop_token& stop) {
  constexpr auto kMode = tbb::filter_mode::serial_in_order;
  // An exception would make the pipeline drop earlier frames; so none leaves a stage (Stage).
  auto chain = tbb::make_filter<void, Token*>(kMode, [&](tbb::flow_control& flow) {
    Token* token = read(source, stop);
    if (!token) flow.stop();
    return token;
  });
  const auto append = [&chain](const auto& work) {
    chain &= tbb::make_filter<Token*, Token*>(kMode, [work](Token* token) {
      work(*token);
      return token;
    });
  };
  append([this](Token& token) { prepare(token); });
  for (std::size_t i = 0; i < trackers.size(); ++i) append([this, i](Token& t) { track(i, t); });
  const auto last = tbb::make_filter<Token*, void>(kMode, [this](Token* t) { deliver(*t); });
  device.workers().execute([&] { tbb::parallel_pipeline(kFramesInFlight, chain & last); });
}

void Scheduler::State::advance(Source& source, const std::stop_token& stop) {
  started = true;
  for (Token& token : tokens) token.reported.resize(trackers.size());
  if (device.workers().threads() == 1) {
    run_serial(source, stop);
  } else {
    run_pipeline(source, stop);
  }
}

void Scheduler::State::finish() {
  for (TrackerStage& entry : trackers) {
    if (entry.stage.threw()) continue;
    const std::exception_ptr failure =
        entry.stage.attempt([&] { entry.tracker->finish(entry.log); });
    if (!error) error = failure;
  }
}

Scheduler::Scheduler(const Device& device, FramePreparer preparer, const PointsConfig& points)
    : state_(std::make_unique<State>(device, std::move(preparer), points)) {}
Scheduler::~Scheduler() = default;
Scheduler::Scheduler(Scheduler&&) noexcept = default;

void Scheduler::add(std::unique_ptr<Tracker> tracker, std::string name) {
  if (tracker->feed() != Feed::frames) find_points();
  TrackerStage& entry =
      state_->trackers.emplace_back(TrackerStage{std::move(tracker), {}, Stage(std::move(name))});
  state_->logs.push_back(&entry.log);
}

void Scheduler::add(Sink& sink) { state_->sinks.push_back(&sink); }

void Scheduler::find_points() { state_->finds_points = true; }

std::int64_t Scheduler::run(Source& source, const std::stop_token& stop) {
  if (state_->started) throw std::logic_error("a Scheduler runs once: make another");
  state_->advance(source, stop);
  if (stop.stop_requested()) drop_held();
  finish();
  return state_->delivered;
}

void Scheduler::prime(std::int64_t frames) {
  if (state_->started) throw std::logic_error("prime() before the first frame");
  state_->held.hold(static_cast<std::size_t>(std::max<std::int64_t>(frames, 0)));
}

bool Scheduler::holds_frames() const { return !state_->held.empty(); }

void Scheduler::drop_held() { state_->held.clear(); }

void Scheduler::release_primed() { state_->held.release(); }

void Scheduler::advance(Source& source, const std::stop_token& stop) {
  if (state_->finished) throw std::logic_error("a Scheduler ends once: make another");
  state_->advance(source, stop);
  if (state_->error) std::rethrow_exception(state_->error);
}

void Scheduler::finish() {
  if (std::exchange(state_->finished, true)) return;
  if (holds_frames() && !state_->error) {
    release_primed();
    NoMoreFrames end;
    state_->advance(end, {});
  }
  state_->finish();
  if (state_->error) std::rethrow_exception(state_->error);
}

void Scheduler::set_settings(std::string toml) { state_->settings = std::move(toml); }

CheckpointLabel Scheduler::label(std::string maker) const {
  CheckpointLabel label{std::string(library_version()),
                        std::move(maker),
                        std::string(name(state_->device.kind())),
                        {},
                        state_->settings,
                        state_->next_frame};
  for (const TrackerStage& entry : state_->trackers)
    label.trackers.push_back(entry.stage.time().stage);
  return label;
}

// Scratch memory and clocks are no state, and what is in tokens is gone between two advance().
void Scheduler::put_state(ByteWriter& to) const {
  const State& s = *state_;
  if (s.error) std::rethrow_exception(s.error);
  if (s.finished) throw std::logic_error("a finished run has no checkpoint: take it before");
  if (!s.held.empty()) {
    throw std::logic_error("frames are held by prime(): release_primed() and advance() first");
  }
  put_bytes(to, s.next_frame), put_bytes(to, s.delivered);
  s.preparer.save(to);
  for (const TrackerStage& entry : s.trackers) entry.tracker->save(to), put_bytes(to, entry.log);
}

void Scheduler::take_state(ByteReader& from, After after) {
  State& s = *state_;
  s.started = s.finished = true;  // if this fails: half a state is no use
  take_bytes(from, s.next_frame), take_bytes(from, s.delivered);
  require_frame_number(s.next_frame), require_frame_number(s.delivered);
  if (s.next_frame > 0) s.held.clear();  // the state holds what was learned
  s.preparer.restore(from);
  for (TrackerStage& entry : s.trackers) entry.tracker->restore(from), take_bytes(from, entry.log);
  require_bytes(after == After::more || from.left() == 0, "it is too long");
  s.started = s.finished = false;
}

std::string Scheduler::checkpoint() const {
  ByteWriter to = begin_checkpoint(label("Scheduler"));
  put_state(to);
  return seal_checkpoint(std::move(to));
}

void Scheduler::restore(std::string_view checkpoint) {
  if (state_->started) throw std::logic_error("restore() before the first frame");
  OpenCheckpoint open = open_checkpoint(checkpoint);
  require_same(open.label, label("Scheduler"));
  refuse_damaged([&] { take_state(open.state, After::nothing); });
}

const std::vector<const TrackLog*>& Scheduler::logs() const { return state_->logs; }

void Scheduler::keep(std::int64_t frames) { state_->kept = frames; }

void Scheduler::reserve(std::size_t points) {
  for (TrackerStage& entry : state_->trackers) entry.log.reserve(points);
}

const Tracker& Scheduler::tracker(std::size_t i) const { return *state_->trackers.at(i).tracker; }

const FramePreparer& Scheduler::preparer() const { return state_->preparer; }

std::int64_t Scheduler::frames() const { return state_->delivered; }

std::vector<StageTime> Scheduler::stage_times() const {
  std::vector<StageTime> times{state_->reading.time(), state_->preparing.time()};
  for (const TrackerStage& entry : state_->trackers) times.push_back(entry.stage.time());
  times.push_back(state_->delivering.time());
  return times;
}

}  // namespace glint
