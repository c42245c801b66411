// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/scheduler_state.hpp"

#include <tbb/parallel_pipeline.h>

#include <utility>

namespace glint {

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
    token.cues = std::move(source.cues);
    for (const Cue& cue : token.cues) checked(cue);
    token.source.reset();
    if (finds_points) token.scan.points = token.points;
  });
  if (token.failed) stopping = true;
}

void Scheduler::State::track(std::size_t i, Token& token) {
  TrackerStage& entry = trackers[i];
  entry.stage.pass(token, [&] {
    token.scan.cues = entry.cues.due(token.cues, token.scan, entry.tracker->feed());
    if (token.scan.looked || entry.tracker->feed() != Feed::points) {
      entry.tracker->step(token.scan, entry.log);
    }
    token.scan.cues = {};  // they are the stage's, and go with its next scan
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

}  // namespace glint
