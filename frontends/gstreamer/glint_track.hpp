// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <glib-object.h>

/// The element glinttrack: grey pictures pass through and leave with their tracks.
/// `gst-inspect-1.0 glinttrack` shows what it takes and what it posts.
GType glint_track_get_type();
