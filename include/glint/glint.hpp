// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Glint's interface for C++: frames in, tracks out. Public is what this file takes in; other
/// headers of the package may change with any version.
///
///     glint::Engine engine("mm-phd", {{"snr_low", 6}, {"seed", 1}});
///     while (more frames) engine.push({pixels, width, height}, time);
///     engine.finish();
///     for (const auto& result : engine.results())
///       for (const auto& track : result.tracks) use(track.x, track.y);
///
/// - Engine (push) tracks on threads of its own while the program goes on; Engine::poll() takes
/// results
///   as they come, Engine::checkpoint() and restore() go on in another process.
/// - Scheduler (pull) runs through a Source of the program's own, and hands each scan to its Sinks.
/// - Settings are those that `glint config TRACKER` prints.
///
/// Positions are in [px]; (0, 0) is the centre of the first pixel, x to the right, y down. Nothing
/// here depends on instruction-set flags: a program may be compiled with others than the library.
/// Exceptions: ConfigError for settings, CheckpointError for checkpoints, std::invalid_argument for
/// pixels, std::logic_error for calls out of order, std::runtime_error for all else; each says what
/// to do instead.
#include "glint/engine/engine.hpp"
#include "glint/engine/errors.hpp"
#include "glint/engine/scheduler.hpp"
#include "glint/engine/settings.hpp"
#include "glint/engine/source.hpp"
#include "glint/engine/state/checkpoint.hpp"
#include "glint/engine/tracks/track_log.hpp"
