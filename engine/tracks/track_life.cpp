// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/tracks/track_life.hpp"

#include <cmath>

namespace glint {

void check(const HitLogic& logic) {
  if (logic.confirm_hits > logic.confirm_window) {
    throw ConfigError("confirm_hits must not exceed confirm_window: lower it or widen the window");
  }
}

void describe(FieldList& f, TrackLifeConfig& c) {
  f("survival", c.survival, 0.01, 1, "", "probability that a target lasts from scan to scan");
  f("birth_existence", c.birth_existence, 1e-6, 0.999, "",
    "probability that two points in a row are a new target");
  f("confirm_hits", c.confirm_hits, 2, 1000, "scans", "seen this often ...");
  f("confirm_window", c.confirm_window, 2, 1000, "scans",
    "... within so many scans, the first two points included, a track is confirmed, else it ends");
  f("confirm_existence", c.confirm_existence, 0, 1, "",
    "least probability of existence to be confirmed");
  f("halt_misses", c.halt_misses, 0, 1000000, "scans",
    "missed this often in a row, a confirmed track ends; 0 is never");
  f("halt_existence", c.halt_existence, 0, 1, "",
    "a track that exists with less probability ends; 0 is never");
}

TrackLife::TrackLife(const TrackLifeConfig& config, bool known)
    : existence_(known ? 1 : config.birth_existence), confirmed_(known) {}

void TrackLife::see(const TrackLifeConfig& config, bool hit, double ratio, double step) {
  const double predicted = existence_ * std::pow(config.survival, step);
  existence_ = ratio * predicted / (1 - predicted + ratio * predicted);
  judge(config, hit, existence_ >= config.confirm_existence, existence_ < config.halt_existence);
}

TrackLife::TrackLife(const HitLogic& logic, bool known)
    : existence_(TrackPoint::kUnknown),
      confirmed_(known || logic.confirm_hits <= 1),
      age_(1),
      hits_(1) {}

void TrackLife::see(const HitLogic& logic, bool hit) { judge(logic, hit, true, false); }

/// `sure` and `unlikely`: what the probability of existence says.
void TrackLife::judge(const HitLogic& logic, bool hit, bool sure, bool unlikely) {
  ++age_, hits_ += hit, misses_ = hit ? 0 : misses_ + 1;
  if (confirmed_) {
    over_ = (logic.halt_misses > 0 && misses_ >= logic.halt_misses) || unlikely;
    return;
  }
  confirmed_ = hits_ >= logic.confirm_hits && sure;
  over_ = !confirmed_ && (age_ >= logic.confirm_window || unlikely);
}

TrackStatus TrackLife::status() const {
  if (over_) return TrackStatus::halted;
  return confirmed_ ? TrackStatus::confirmed : TrackStatus::tentative;
}

}  // namespace glint
