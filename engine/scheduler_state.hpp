// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "glint/engine/cue.hpp"
#include "glint/engine/held_frames.hpp"
#include "glint/engine/pipeline_stage.hpp"
#include "glint/engine/scheduler.hpp"

namespace glint {

/// A tracker, its log and its stage.
struct TrackerStage {
  std::unique_ptr<Tracker> tracker;
  TrackLog log;
  Stage stage;
  TrackerCues cues = {};
};

/// What a Scheduler holds, and the stages that its frames pass.
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

}  // namespace glint
