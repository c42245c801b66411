// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/cue.hpp"

#include <algorithm>
#include <stdexcept>

#include "glint/engine/scan.hpp"
#include "glint/engine/state/bytes.hpp"
#include "glint/engine/tracks/tracker.hpp"

namespace glint {
namespace {

constexpr double kMost = 1e9;  // [px], [px/s]: far from what arithmetic in float can hold

bool bounded(double value) { return std::abs(value) <= kMost; }  // false for NaN

bool usable(const Scan& scan, Feed feed) {
  if (feed == Feed::frames) return scan.whitened.width() > 0 || scan.raw.width() > 0;
  return feed == Feed::both || scan.looked;
}

bool inside(const Cue& cue, const Frame& frame) {
  return cue.x >= -0.5 && cue.x < frame.width() - 0.5 && cue.y >= -0.5 &&
         cue.y < frame.height() - 0.5;
}

const char* fault_of(const Cue& cue) {
  if (!bounded(cue.x) || !bounded(cue.y)) {
    return "a cue's x and y must be numbers of at most 1e9 [px]";
  }
  const bool unknown = std::isnan(cue.vx) && std::isnan(cue.vy);
  if (!unknown && !(bounded(cue.vx) && bounded(cue.vy))) {
    return "a cue's vx and vy must both be numbers of at most 1e9 [px/s], or both be left out";
  }
  if (!std::isnan(cue.sigma) && !(cue.sigma > 0 && bounded(cue.sigma))) {
    return "a cue's sigma must be above 0 and at most 1e9 [px]; leave it out if it is not known";
  }
  return nullptr;
}

}  // namespace

void Cue::restored() const { require_bytes(fault_of(*this) == nullptr, "a cue is no such"); }

const Cue& checked(const Cue& cue) {
  if (const char* fault = fault_of(cue)) throw std::invalid_argument(fault);
  return cue;
}

void move_on(std::span<Cue> cues, double seconds) {
  for (Cue& cue : cues) {
    if (!cue.moves()) continue;
    cue.x = std::clamp(cue.x + seconds * cue.vx, -kMost, kMost);
    cue.y = std::clamp(cue.y + seconds * cue.vy, -kMost, kMost);
  }
}

std::span<const Cue> TrackerCues::due(std::span<const Cue> cues, const Scan& scan, Feed feed) {
  if (!waiting_.empty()) move_on(waiting_, scan.time - time_);
  time_ = scan.time;
  waiting_.insert(waiting_.end(), cues.begin(), cues.end());
  if (!usable(scan, feed)) return {};
  std::swap(waiting_, due_);
  waiting_.clear();
  if (feed != Feed::points && scan.whitened.width() > 0) {
    std::erase_if(due_, [&](const Cue& cue) { return !inside(cue, scan.whitened); });
  }
  if (!timed_) {
    for (Cue& cue : due_) cue.vx = cue.vy = Cue::kUnknown;
  }
  timed_ = true;
  return due_;
}

}  // namespace glint
