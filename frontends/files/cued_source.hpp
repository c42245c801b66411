// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "glint/engine/source.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint {

/// `frames` with the cues of a .csv table: x, y [px], frame or time [s] and, where they are known,
/// vx, vy [px/s] and sigma [px]. A row with a frame goes with that one; one of a time alone goes
/// with the first frame that is at most half an interval earlier, moved on to its time. With a
/// column track_id, as in tracks that Glint wrote, the first row of each track counts. `warn` is
/// told of cues outside their frame, after the last one, and in a frame before `learned_from`,
/// where the background is not known. Throws UsageError if the file cannot be read,
/// std::runtime_error with file, line and remedy for a row that is no cue.
std::unique_ptr<Source> with_cues(std::unique_ptr<Source> frames, const std::string& path,
                                  const Warn& warn, std::int64_t learned_from = 0);

}  // namespace glint
