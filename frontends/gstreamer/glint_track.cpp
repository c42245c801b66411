// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/gstreamer/glint_track.hpp"

#include <gst/base/gstbasetransform.h>
#include <gst/video/video.h>

#include <algorithm>
#include <array>
#include <exception>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

#include "glint/engine/trackers/registry.hpp"
#include "glint/frontends/gstreamer/boxes.hpp"
#include "glint/frontends/gstreamer/settings.hpp"
#include "glint/frontends/gstreamer/stream.hpp"
#include "glint/frontends/gstreamer/structures.hpp"

using namespace glint;
using namespace glint::gstreamer;

namespace {

/// What the element holds; GObject frees plain memory only.
struct State {
  std::mutex mutex;  // of the properties, which an application may set at any time
  Properties properties;
  bool overlay = false;            // of the running stream
  std::unique_ptr<Stream> stream;  // between start and stop
  bool failed = false;             // an error was posted: nothing more is tracked
};

struct GlintTrack {
  GstBaseTransform parent;
  State* state;
};

struct GlintTrackClass {
  GstBaseTransformClass parent;
};

G_DEFINE_TYPE(GlintTrack, glint_track_element, GST_TYPE_BASE_TRANSFORM)

State& state_of(gpointer element) { return *static_cast<GlintTrack*>(element)->state; }

struct TextProperty {
  const char *name, *nick, *help;
  std::string Properties::*value;
};
constexpr std::array<TextProperty, 6> kTexts{{
    {"tracker", "Tracker",
     "names of the trackers, separated by spaces (mm-phd without any): ", &Properties::tracker},
    {"profile", "Profile",
     "settings that go together: P for targets that stand out of the noise, L for those it hides",
     &Properties::profile},
    {"config-file", "Configuration file", "path of settings as TOML, over the profile's",
     &Properties::config_file},
    {"config", "Configuration",
     "settings as TOML text, as `glint config TRACKER` prints them, over the file's",
     &Properties::config},
    {"set", "Settings", "key=value, separated by semicolons, over all else", &Properties::set},
    {"device", "Device", "where kernels run: auto, serial, tbb, egl or egl:N", &Properties::device},
}};
constexpr guint kOverlay = kTexts.size() + 1;  // properties count from 1

std::string help_of(const TextProperty& property) {
  std::string help = property.help;
  if (property.value != &Properties::tracker) return help;
  for (const TrackerEntry& tracker : all_trackers()) {
    help += (help.ends_with(' ') ? "" : ", ") + std::string(tracker.name);
  }
  return help;
}

void set_property(GObject* object, guint id, const GValue* value, GParamSpec* spec) {
  State& state = state_of(object);
  const std::scoped_lock lock(state.mutex);
  if (id >= 1 && id <= kTexts.size()) {
    const char* text = g_value_get_string(value);
    state.properties.*kTexts[id - 1].value = text == nullptr ? "" : text;
  } else if (id == kOverlay) {
    state.properties.overlay = g_value_get_boolean(value) != FALSE;
  } else {
    G_OBJECT_WARN_INVALID_PROPERTY_ID(object, id, spec);
  }
}

void get_property(GObject* object, guint id, GValue* value, GParamSpec* spec) {
  State& state = state_of(object);
  const std::scoped_lock lock(state.mutex);
  if (id >= 1 && id <= kTexts.size()) {
    g_value_set_string(value, (state.properties.*kTexts[id - 1].value).c_str());
  } else if (id == kOverlay) {
    g_value_set_boolean(value, state.properties.overlay ? TRUE : FALSE);
  } else {
    G_OBJECT_WARN_INVALID_PROPERTY_ID(object, id, spec);
  }
}

/// What the error is about, in GStreamer's terms.
enum class Fault { settings, format, tracking };

/// Runs work() and says whether it threw nothing; else its sentence is the element's error. After
/// the first nothing more is tracked.
template <class Work>
bool attempt(gpointer element, Fault fault, const Work& work) noexcept {
  try {
    work();
    return true;
  } catch (const std::exception& e) {
    state_of(element).failed = true;
    if (fault == Fault::format) {
      GST_ELEMENT_ERROR(element, STREAM, FORMAT, ("%s", e.what()), (nullptr));
    } else if (fault == Fault::settings) {
      GST_ELEMENT_ERROR(element, LIBRARY, SETTINGS, ("%s", e.what()), (nullptr));
    } else {
      GST_ELEMENT_ERROR(element, STREAM, FAILED, ("%s", e.what()), (nullptr));
    }
    return false;
  }
}

bool make_stream(GstBaseTransform* transform) {
  return attempt(transform, Fault::settings, [&] {
    State& state = state_of(transform);
    Properties properties;
    {
      const std::scoped_lock lock(state.mutex);
      properties = state.properties;
    }
    state.overlay = properties.overlay;
    state.stream = std::make_unique<Stream>(properties);
    state.failed = false;
  });
}

gboolean start(GstBaseTransform* transform) { return make_stream(transform) ? TRUE : FALSE; }

gboolean stop(GstBaseTransform* transform) {
  state_of(transform).stream.reset();
  return TRUE;
}

gboolean set_caps(GstBaseTransform* transform, GstCaps* incoming, GstCaps* /*outgoing*/) {
  if (state_of(transform).failed) return FALSE;
  const bool done = attempt(transform, Fault::format, [&] {
    GstVideoInfo info;
    if (gst_video_info_from_caps(&info, incoming) == FALSE) {
      throw std::invalid_argument("the caps describe no grey pictures; put videoconvert in front");
    }
    state_of(transform).stream->set_format(info);
  });
  return done ? TRUE : FALSE;
}

/// Metas can only be put on a buffer of one's own; its memory stays shared.
GstFlowReturn prepare_output_buffer(GstBaseTransform* /*transform*/, GstBuffer* incoming,
                                    GstBuffer** outgoing) {
  *outgoing = gst_buffer_is_writable(incoming) != FALSE ? incoming : gst_buffer_copy(incoming);
  return GST_FLOW_OK;
}

/// A picture's pixels for as long as this lives.
class Mapped {
 public:
  Mapped(GstBuffer* buffer, const GstVideoInfo& info, GstMapFlags flags) {
    // Without a reference of the mapping's own the buffer stays writable.
    const int all = flags | static_cast<int>(GST_VIDEO_FRAME_MAP_FLAG_NO_REF);
    if (gst_video_frame_map(&frame_, &info, buffer, static_cast<GstMapFlags>(all)) == FALSE) {
      throw std::runtime_error(
          "a picture's memory cannot be mapped, or is smaller than its caps say; put videoconvert "
          "in front of glinttrack");
    }
  }
  Mapped(const Mapped&) = delete;
  Mapped& operator=(const Mapped&) = delete;
  ~Mapped() { gst_video_frame_unmap(&frame_); }
  GstVideoFrame& frame() { return frame_; }

 private:
  GstVideoFrame frame_;
};

EngineResult tracks_of(Stream& stream, GstBuffer* buffer) {
  Mapped picture(buffer, stream.format(), GST_MAP_READ);
  return stream.track(picture.frame(), GST_BUFFER_PTS(buffer));
}

/// Mapped to be written, shared memory is copied.
void draw(const Stream& stream, GstBuffer* buffer, const EngineResult& result) {
  constexpr int kReadWrite = GST_MAP_READ | GST_MAP_WRITE;
  Mapped picture(buffer, stream.format(), static_cast<GstMapFlags>(kReadWrite));
  draw_boxes(picture.frame(), result.tracks);
}

void post(GstBaseTransform* transform, GstStructure* structure) {
  gst_element_post_message(GST_ELEMENT(transform),
                           gst_message_new_element(GST_OBJECT(transform), structure));
}

GstFlowReturn transform_ip(GstBaseTransform* transform, GstBuffer* buffer) {
  State& state = state_of(transform);
  if (state.failed) return GST_FLOW_ERROR;
  const bool done = attempt(transform, Fault::tracking, [&] {
    Stream& stream = *state.stream;
    const EngineResult result = tracks_of(stream, buffer);
    const GstVideoInfo& format = stream.format();
    add_regions(*buffer, result, stream.trackers(), GST_VIDEO_INFO_WIDTH(&format),
                GST_VIDEO_INFO_HEIGHT(&format));
    if (state.overlay) draw(stream, buffer, result);
    post(transform, tracks_message(result, GST_BUFFER_PTS(buffer), stream.trackers()));
  });
  return done ? GST_FLOW_OK : GST_FLOW_ERROR;
}

/// At the end the trackers say what they still hold.
void finish(GstBaseTransform* transform) {
  State& state = state_of(transform);
  if (state.failed) return;
  attempt(transform, Fault::tracking, [&] {
    const Scheduler& scheduler = state.stream->finish();
    post(transform, revised_message(scheduler, state.stream->trackers()));
  });
}

/// The next pictures follow on none.
bool begin_anew(GstBaseTransform* transform) {
  const std::unique_ptr<Stream> last = std::move(state_of(transform).stream);
  if (!make_stream(transform)) return false;
  GstCaps* caps = gst_pad_get_current_caps(GST_BASE_TRANSFORM_SINK_PAD(transform));
  if (caps == nullptr) return true;
  const bool done = set_caps(transform, caps, caps) != FALSE;
  gst_caps_unref(caps);
  return done;
}

/// An application's word for a target in the next picture. One that is none stops no pictures.
void start_track(GstBaseTransform* transform, const GstStructure& target) {
  try {
    state_of(transform).stream->start(target);
  } catch (const std::exception& e) {
    GST_ELEMENT_WARNING(transform, STREAM, FAILED, ("glint-start: %s", e.what()), (nullptr));
  }
}

gboolean sink_event(GstBaseTransform* transform, GstEvent* event) {
  State& state = state_of(transform);
  // One that is not in line with the pictures would come on another thread.
  if (state.stream && GST_EVENT_IS_SERIALIZED(event) &&
      gst_event_has_name(event, "glint-start") != FALSE) {
    start_track(transform, *gst_event_get_structure(event));
    gst_event_unref(event);
    return TRUE;
  }
  if (state.stream) {
    if (GST_EVENT_TYPE(event) == GST_EVENT_EOS) finish(transform);
    if (GST_EVENT_TYPE(event) == GST_EVENT_FLUSH_STOP) begin_anew(transform);
  }
  return GST_BASE_TRANSFORM_CLASS(glint_track_element_parent_class)->sink_event(transform, event);
}

/// Rows may lie any distance apart.
gboolean propose_allocation(GstBaseTransform* /*transform*/, GstQuery* /*decided*/,
                            GstQuery* query) {
  gst_query_add_allocation_meta(query, GST_VIDEO_META_API_TYPE, nullptr);
  return TRUE;
}

void finalize(GObject* object) {
  delete static_cast<GlintTrack*>(static_cast<gpointer>(object))->state;
  G_OBJECT_CLASS(glint_track_element_parent_class)->finalize(object);
}

void glint_track_element_init(GlintTrack* element) {
  element->state = new State;
  auto* transform = GST_BASE_TRANSFORM(element);
  gst_base_transform_set_in_place(transform, TRUE);
  // Which pictures are tracked may not depend on how fast they are shown.
  gst_base_transform_set_qos_enabled(transform, FALSE);
}

void install_properties(GObjectClass* object) {
  constexpr auto kFlags = static_cast<GParamFlags>(static_cast<int>(G_PARAM_READWRITE) |
                                                   static_cast<int>(G_PARAM_STATIC_STRINGS) |
                                                   static_cast<int>(GST_PARAM_MUTABLE_READY));
  static std::array<std::string, kTexts.size()> help;
  for (std::size_t i = 0; i < kTexts.size(); ++i) {
    help[i] = help_of(kTexts[i]);
    g_object_class_install_property(
        object, static_cast<guint>(i + 1),
        g_param_spec_string(kTexts[i].name, kTexts[i].nick, help[i].c_str(), "", kFlags));
  }
  g_object_class_install_property(
      object, kOverlay,
      g_param_spec_boolean("overlay", "Overlay",
                           "draw a box around each confirmed track into the picture", FALSE,
                           kFlags));
}

void describe_element(GstElementClass* element) {
  gst_element_class_set_static_metadata(
      element, "Glint tracker", "Filter/Analyzer/Video",
      "Follows targets too dim for any single frame. Each grey picture passes through as it is and "
      "leaves with its tracks: a GstVideoRegionOfInterestMeta each (type: the tracker's name, id: "
      "the track's, a parameter \"track\" with x, y [px], vx, vy [px/s], existence, status, ...), "
      "and an element message \"glint-tracks\" with all of them; at the end one \"glint-revised\"",
      "The developers of Glint");
  GstCaps* caps = gst_caps_from_string(GST_VIDEO_CAPS_MAKE("{ GRAY8, GRAY16_LE }"));
  for (const auto& [name, direction] :
       {std::pair{"sink", GST_PAD_SINK}, std::pair{"src", GST_PAD_SRC}}) {
    gst_element_class_add_pad_template(element,
                                       gst_pad_template_new(name, direction, GST_PAD_ALWAYS, caps));
  }
  gst_caps_unref(caps);
}

void glint_track_element_class_init(GlintTrackClass* type) {
  GObjectClass* object = G_OBJECT_CLASS(type);
  object->set_property = set_property;
  object->get_property = get_property;
  object->finalize = finalize;
  install_properties(object);
  describe_element(GST_ELEMENT_CLASS(type));
  GstBaseTransformClass* transform = GST_BASE_TRANSFORM_CLASS(type);
  transform->start = start;
  transform->stop = stop;
  transform->set_caps = set_caps;
  transform->prepare_output_buffer = prepare_output_buffer;
  transform->transform_ip = transform_ip;
  transform->sink_event = sink_event;
  transform->propose_allocation = propose_allocation;
}

}  // namespace

GType glint_track_get_type() { return glint_track_element_get_type(); }
