// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/scheduler.hpp"

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <utility>

#include "glint/engine/scheduler_state.hpp"
#include "glint/engine/state/fields.hpp"

namespace glint {
namespace {

class NoMoreFrames : public Source {
 public:
  std::optional<SourceFrame> next() override { return std::nullopt; }
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
  for (const TrackerStage& entry : s.trackers) {
    entry.tracker->save(to);
    put_bytes(to, entry.log), put_bytes(to, entry.cues);
  }
}

void Scheduler::take_state(ByteReader& from, After after) {
  State& s = *state_;
  s.started = s.finished = true;  // if this fails: half a state is no use
  take_bytes(from, s.next_frame), take_bytes(from, s.delivered);
  require_frame_number(s.next_frame), require_frame_number(s.delivered);
  if (s.next_frame > 0) s.held.clear();  // the state holds what was learned
  s.preparer.restore(from);
  for (TrackerStage& entry : s.trackers) {
    entry.tracker->restore(from);
    take_bytes(from, entry.log), take_bytes(from, entry.cues);
  }
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
