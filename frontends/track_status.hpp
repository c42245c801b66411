// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string_view>

#include "glint/engine/tracks/track_log.hpp"

namespace glint {

/// As tracks are written: "tentative", "confirmed", "halted". The text ends in a zero.
inline std::string_view name(TrackStatus status) {
  switch (status) {
    case TrackStatus::tentative:
      return "tentative";
    case TrackStatus::confirmed:
      return "confirmed";
    case TrackStatus::halted:
      break;
  }
  return "halted";
}

}  // namespace glint
