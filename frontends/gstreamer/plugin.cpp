// SPDX-License-Identifier: Apache-2.0
// The plugin's entry: GStreamer reads name, version and licence here.
#include <gst/gst.h>

#include "glint/frontends/gstreamer/glint_track.hpp"

#define PACKAGE "glint"

namespace {

gboolean register_elements(GstPlugin* plugin) {
  return gst_element_register(plugin, "glinttrack", GST_RANK_NONE, glint_track_get_type());
}

}  // namespace

GST_PLUGIN_DEFINE(GST_VERSION_MAJOR, GST_VERSION_MINOR, glint,
                  "Finds and follows targets too dim for any single frame", register_elements,
                  GLINT_VERSION, "Apache 2.0", "Glint", "Glint")
