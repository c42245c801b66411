// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/gstreamer/structures.hpp"

#include <gst/video/gstvideometa.h>

#include "glint/frontends/gstreamer/boxes.hpp"
#include "glint/frontends/track_status.hpp"

namespace glint::gstreamer {
namespace {

GstStructure* track_structure(const TrackPoint& p, const std::string& tracker) {
  return gst_structure_new(
      "track", "tracker", G_TYPE_STRING, tracker.c_str(), "frame", G_TYPE_INT64,
      static_cast<gint64>(p.frame), "time", G_TYPE_DOUBLE, p.time, "track-id", G_TYPE_INT64,
      static_cast<gint64>(p.track_id), "status", G_TYPE_STRING, name(p.status).data(), "x",
      G_TYPE_DOUBLE, p.x, "y", G_TYPE_DOUBLE, p.y, "vx", G_TYPE_DOUBLE, p.vx, "vy", G_TYPE_DOUBLE,
      p.vy, "intensity", G_TYPE_DOUBLE, p.intensity, "existence", G_TYPE_DOUBLE, p.existence,
      "var-x", G_TYPE_DOUBLE, p.var_x, "cov-xy", G_TYPE_DOUBLE, p.cov_xy, "var-y", G_TYPE_DOUBLE,
      p.var_y, "cov-x-vx", G_TYPE_DOUBLE, p.cov_x_vx, "cov-x-vy", G_TYPE_DOUBLE, p.cov_x_vy,
      "cov-y-vx", G_TYPE_DOUBLE, p.cov_y_vx, "cov-y-vy", G_TYPE_DOUBLE, p.cov_y_vy, "var-vx",
      G_TYPE_DOUBLE, p.var_vx, "cov-vx-vy", G_TYPE_DOUBLE, p.cov_vx_vy, "var-vy", G_TYPE_DOUBLE,
      p.var_vy, nullptr);
}

const std::string& name_of(const Track& track, std::span<const std::string> trackers) {
  return trackers[static_cast<std::size_t>(track.tracker)];
}

/// A list as the value of a structure's field.
class List {
 public:
  List() { g_value_init(&list_, GST_TYPE_LIST); }
  List(const List&) = delete;
  List& operator=(const List&) = delete;
  ~List() { g_value_unset(&list_); }

  void append(GstStructure* structure) {  // takes it
    GValue value = G_VALUE_INIT;
    g_value_init(&value, GST_TYPE_STRUCTURE);
    g_value_take_boxed(&value, structure);
    gst_value_list_append_and_take_value(&list_, &value);
  }
  void append(const std::string& text) {
    GValue value = G_VALUE_INIT;
    g_value_init(&value, G_TYPE_STRING);
    g_value_set_string(&value, text.c_str());
    gst_value_list_append_and_take_value(&list_, &value);
  }
  void append(std::span<const TrackPoint> points, const std::string& tracker) {
    for (const TrackPoint& point : points) append(track_structure(point, tracker));
  }
  void give_to(GstStructure* structure, const char* field) const {
    gst_structure_set_value(structure, field, &list_);
  }

 private:
  GValue list_ = G_VALUE_INIT;
};

}  // namespace

GstStructure* tracks_message(const EngineResult& result, GstClockTime timestamp,
                             std::span<const std::string> trackers) {
  List tracks;
  for (const Track& track : result.tracks) {
    tracks.append(track_structure(track, name_of(track, trackers)));
  }
  GstStructure* message = gst_structure_new(
      "glint-tracks", "frame", G_TYPE_INT64, static_cast<gint64>(result.frame), "time",
      G_TYPE_DOUBLE, result.time, "timestamp", G_TYPE_UINT64, static_cast<guint64>(timestamp),
      "latency", G_TYPE_DOUBLE, result.latency, nullptr);
  tracks.give_to(message, "tracks");
  return message;
}

GstStructure* revised_message(const Scheduler& scheduler, std::span<const std::string> trackers) {
  List tracks, notes;
  for (const std::string& note : scheduler.preparer().notes()) notes.append(note);
  for (std::size_t i = 0; i < trackers.size(); ++i) {
    tracks.append(scheduler.logs()[i]->revised(), trackers[i]);
    for (const std::string& note : scheduler.tracker(i).notes()) notes.append(note);
  }
  GstStructure* message = gst_structure_new("glint-revised", "frames", G_TYPE_INT64,
                                            static_cast<gint64>(scheduler.frames()), nullptr);
  notes.give_to(message, "notes");
  tracks.give_to(message, "tracks");
  return message;
}

void add_regions(GstBuffer& buffer, const EngineResult& result,
                 std::span<const std::string> trackers, int width, int height) {
  for (const Track& track : result.tracks) {
    const auto box = box_around(track, kBoxRadius, width, height);
    if (!box || track.status == TrackStatus::halted) continue;
    const std::string& tracker = name_of(track, trackers);
    GstVideoRegionOfInterestMeta* region = gst_buffer_add_video_region_of_interest_meta(
        &buffer, tracker.c_str(), static_cast<guint>(box->left), static_cast<guint>(box->top),
        static_cast<guint>(box->right - box->left), static_cast<guint>(box->bottom - box->top));
    region->id = static_cast<gint>(track.track_id);
    gst_video_region_of_interest_meta_add_param(region, track_structure(track, tracker));
  }
}

}  // namespace glint::gstreamer
