// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>

#include "glint/engine/filters/peaks.hpp"
#include "glint/engine/filters/step_clock.hpp"
#include "glint/engine/tracks.hpp"

namespace glint {

/// A track point of `estimate`, whose velocity is in px a frame, at that time; track, status and
/// existence are the caller's to say.
TrackPoint point_of(const Peak& estimate, std::size_t modes, const StepTime& at);

}  // namespace glint
