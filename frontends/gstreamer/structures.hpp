// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gst/gst.h>

#include <span>
#include <string>
#include <vector>

#include "glint/engine/engine.hpp"

namespace glint::gstreamer {

/// The message of a frame: "glint-tracks" with frame (gint64), time [s] and latency [s] (gdouble),
/// timestamp [ns] (guint64) and tracks, a list of "track"s. `trackers` are the names.
GstStructure* tracks_message(const EngineResult& result, GstClockTime timestamp,
                             std::span<const std::string> trackers);

/// The message at the end: "glint-revised" with frames (gint64), notes (a list of strings: what was
/// estimated) and tracks of all frames that are kept, as revised later.
GstStructure* revised_message(const Scheduler& scheduler, std::span<const std::string> trackers);

/// Puts a GstVideoRegionOfInterestMeta around each track that is not halted and lies in a picture
/// of that size: its type is the tracker's name, its id the track's, its one parameter a "track".
void add_regions(GstBuffer& buffer, const EngineResult& result,
                 std::span<const std::string> trackers, int width, int height);

}  // namespace glint::gstreamer
