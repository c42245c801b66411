// SPDX-License-Identifier: Apache-2.0
// Runs a pipeline as gst-launch-1.0 does, and keeps what it posts.
#pragma once
#include <gst/gst.h>
#include <gst/video/video.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "glint/engine/tracks/track_log.hpp"

namespace glint::test {

/// Loads GStreamer with this build's plugin; its registry is kept in the build folder.
inline void load_gstreamer() {
  setenv("GST_PLUGIN_PATH", GLINT_GST_PLUGINS, 1);
  setenv("GST_REGISTRY", GLINT_GST_REGISTRY, 1);
  gst_init(nullptr, nullptr);
}

inline double number(const GstStructure* structure, const char* field) {
  double value = 0;
  EXPECT_TRUE(gst_structure_get_double(structure, field, &value)) << field;
  return value;
}

inline std::int64_t integer(const GstStructure* structure, const char* field) {
  gint64 value = -1;
  EXPECT_TRUE(gst_structure_get_int64(structure, field, &value)) << field;
  return value;
}

inline TrackPoint point_of(const GstStructure* s) {
  const std::string status = gst_structure_get_string(s, "status");
  TrackPoint p;
  p.frame = integer(s, "frame"), p.time = number(s, "time"), p.track_id = integer(s, "track-id");
  p.status = status == "confirmed" ? TrackStatus::confirmed
             : status == "halted"  ? TrackStatus::halted
                                   : TrackStatus::tentative;
  p.x = number(s, "x"), p.y = number(s, "y"), p.vx = number(s, "vx"), p.vy = number(s, "vy");
  p.intensity = number(s, "intensity"), p.existence = number(s, "existence");
  p.set_covariance({number(s, "var-x"), number(s, "cov-xy"), number(s, "var-y"),
                    number(s, "cov-x-vx"), number(s, "cov-x-vy"), number(s, "cov-y-vx"),
                    number(s, "cov-y-vy"), number(s, "var-vx"), number(s, "cov-vx-vy"),
                    number(s, "var-vy")});
  return p;
}

inline std::vector<TrackPoint> points_of(const GstStructure* message) {
  std::vector<TrackPoint> points;
  const GValue* list = gst_structure_get_value(message, "tracks");
  for (guint i = 0; i < gst_value_list_get_size(list); ++i) {
    points.push_back(point_of(gst_value_get_structure(gst_value_list_get_value(list, i))));
  }
  return points;
}

/// A "glint-tracks" message.
struct Posted {
  std::int64_t frame;
  double time;
  std::vector<TrackPoint> tracks;
};

class Pipeline {
 public:
  explicit Pipeline(const std::string& text) {
    load_gstreamer();
    GError* error = nullptr;
    pipeline_ = gst_parse_launch(text.c_str(), &error);
    if (error != nullptr) ADD_FAILURE() << text << ": " << error->message;
    g_clear_error(&error);
  }
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;
  ~Pipeline() {
    gst_element_set_state(pipeline_, GST_STATE_NULL);
    gst_object_unref(pipeline_);
  }

  /// Calls f(buffer) for all that passes that pad of the element of that name.
  void watch(const char* element, const char* pad, std::function<void(GstBuffer*)> f) {
    GstElement* found = gst_bin_get_by_name(GST_BIN(pipeline_), element);
    GstPad* at = gst_element_get_static_pad(found, pad);
    gst_pad_add_probe(
        at, GST_PAD_PROBE_TYPE_BUFFER,
        [](GstPad*, GstPadProbeInfo* info, gpointer user) {
          (*static_cast<std::function<void(GstBuffer*)>*>(user))(GST_PAD_PROBE_INFO_BUFFER(info));
          return GST_PAD_PROBE_OK;
        },
        new std::function(std::move(f)),
        [](gpointer user) { delete static_cast<std::function<void(GstBuffer*)>*>(user); });
    gst_object_unref(at);
    gst_object_unref(found);
  }

  /// To the sink pad of the element of that name.
  void send(const char* element, GstEvent* event) {
    GstElement* found = gst_bin_get_by_name(GST_BIN(pipeline_), element);
    GstPad* at = gst_element_get_static_pad(found, "sink");
    EXPECT_TRUE(gst_pad_send_event(at, event));
    gst_object_unref(at);
    gst_object_unref(found);
  }

  /// To the first frame, where it waits.
  void preroll() {
    gst_element_set_state(pipeline_, GST_STATE_PAUSED);
    EXPECT_EQ(gst_element_get_state(pipeline_, nullptr, nullptr, 60 * GST_SECOND),
              GST_STATE_CHANGE_SUCCESS);
  }
  void seek_to_start() {
    EXPECT_TRUE(gst_element_seek_simple(pipeline_, GST_FORMAT_TIME, GST_SEEK_FLAG_FLUSH, 0));
  }
  /// To the end or to an error, whose message it gives: empty at the end.
  std::string run() {
    gst_element_set_state(pipeline_, GST_STATE_PLAYING);
    std::string error = until_the_end();
    gst_element_set_state(pipeline_, GST_STATE_NULL);
    return error;
  }

  std::vector<Posted> posted;
  std::vector<TrackPoint> revised;
  int ends = 0;  // "glint-revised" messages

 private:
  std::string until_the_end() {
    constexpr int kTypes = GST_MESSAGE_EOS | GST_MESSAGE_ERROR | GST_MESSAGE_ELEMENT;
    GstBus* bus = gst_element_get_bus(pipeline_);
    std::string error = "nothing within two minutes";
    while (GstMessage* message = gst_bus_timed_pop_filtered(bus, 120 * GST_SECOND,
                                                            static_cast<GstMessageType>(kTypes))) {
      const bool last = take(message, error);
      gst_message_unref(message);
      if (last) break;
    }
    gst_object_unref(bus);
    return error;
  }
  bool take(GstMessage* message, std::string& error) {
    const GstStructure* structure = gst_message_get_structure(message);
    if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_EOS) return error.clear(), true;
    if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_ERROR) {
      GError* said = nullptr;
      gst_message_parse_error(message, &said, nullptr);
      error = said->message;
      g_error_free(said);
      return true;
    }
    if (gst_structure_has_name(structure, "glint-tracks")) {
      posted.push_back(
          {integer(structure, "frame"), number(structure, "time"), points_of(structure)});
    } else if (gst_structure_has_name(structure, "glint-revised")) {
      revised = points_of(structure), ++ends;
    }
    return false;
  }

  GstElement* pipeline_ = nullptr;
};

/// The bytes of a picture without gaps between rows.
inline std::string pixels_of(GstBuffer* buffer) {
  GstMapInfo map;
  if (gst_buffer_map(buffer, &map, GST_MAP_READ) == FALSE) return {};
  std::string bytes(reinterpret_cast<const char*>(map.data), map.size);
  gst_buffer_unmap(buffer, &map);
  return bytes;
}

}  // namespace glint::test
