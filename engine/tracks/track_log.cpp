// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/tracks/track_log.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

#include "glint/engine/number_text.hpp"
#include "glint/engine/state/fields.hpp"

namespace glint {
namespace {

void append_point(std::string& out, const TrackPoint& p) {
  static constexpr std::array<std::string_view, 3> kStatus{"tentative", "confirmed", "halted"};
  out += std::to_string(p.frame) + ' ' + std::to_string(p.track_id) + ' ';
  out += kStatus[static_cast<std::size_t>(p.status)];
  const auto append = [&](double value) {
    out += ' ';
    append_number(out, value);
  };
  for (const double value :
       {p.time, p.x, p.y, p.vx, p.vy, p.intensity, p.existence, p.var_x, p.cov_xy, p.var_y}) {
    append(value);
  }
  for (const double value : velocity_covariance(p)) append(value);
  for (const double value : p.mode_probability) append(value);
  out += '\n';
}

std::vector<TrackPoint> all_points(const TrackTable& table) {
  std::vector<TrackPoint> points;
  table.each([&](const TrackPoint& p) { points.push_back(p); });
  return points;
}

}  // namespace

void TrackTable::reserve(std::size_t points) {
  frames_.reserve(points);
  nodes_.reserve(points);
}

std::size_t TrackTable::lower_bound(std::int64_t frame) const {
  if (frames_.empty() || frames_.back().frame < frame) return frames_.size();
  const auto it = std::ranges::lower_bound(frames_, frame, {}, &FrameChain::frame);
  return static_cast<std::size_t>(it - frames_.begin());
}

TrackTable::Place TrackTable::find(const FrameChain& chain, std::int64_t track_id) const {
  if (chain.last != kNone && nodes_[chain.last].point.track_id < track_id) {
    return {chain.last, kNone};
  }
  Place place{kNone, chain.first};
  while (place.node != kNone && nodes_[place.node].point.track_id < track_id) {
    place = {place.node, nodes_[place.node].next};
  }
  const bool found = place.node != kNone && nodes_[place.node].point.track_id == track_id;
  return {place.before, found ? place.node : kNone};
}

std::size_t TrackTable::take_node(const TrackPoint& point) {
  if (free_ == kNone) {
    nodes_.push_back({point, kNone});
    return nodes_.size() - 1;
  }
  const std::size_t node = std::exchange(free_, nodes_[free_].next);
  nodes_[node] = {point, kNone};
  return node;
}

void TrackTable::put(const TrackPoint& point) {
  if (point.frame < forgotten_) return;
  const std::size_t i = lower_bound(point.frame);
  if (i == frames_.size() || frames_[i].frame != point.frame) {
    frames_.insert(frames_.begin() + static_cast<std::ptrdiff_t>(i), FrameChain{point.frame});
  }
  const Place place = find(frames_[i], point.track_id);
  if (place.node != kNone) {
    nodes_[place.node].point = point;
    return;
  }
  const std::size_t node = take_node(point);
  std::size_t& link = link_after(frames_[i], place.before);
  nodes_[node].next = link;
  link = node;
  if (frames_[i].last == place.before) frames_[i].last = node;
}

void TrackTable::remove(std::int64_t track_id, std::int64_t frame) {
  for (std::size_t i = lower_bound(frame); i < frames_.size(); ++i) {
    const Place place = find(frames_[i], track_id);
    if (place.node == kNone) continue;
    link_after(frames_[i], place.before) = nodes_[place.node].next;
    if (frames_[i].last == place.node) frames_[i].last = place.before;
    free_node(place.node);
  }
}

void TrackTable::forget(std::int64_t frame) {
  forgotten_ = std::max(forgotten_, frame);
  const std::size_t end = lower_bound(frame);
  for (std::size_t i = 0; i < end; ++i) {
    for (std::size_t n = frames_[i].first; n != kNone;) {
      const std::size_t next = nodes_[n].next;
      free_node(n);
      n = next;
    }
  }
  frames_.erase(frames_.begin(), frames_.begin() + static_cast<std::ptrdiff_t>(end));
}

void TrackTable::put_to(ByteWriter& to) const {
  std::uint64_t count = 0;
  each([&](const TrackPoint&) { ++count; });
  put_bytes(to, forgotten_), put_bytes(to, count);
  each([&](const TrackPoint& p) { put_bytes(to, p); });
}

void TrackTable::take_from(ByteReader& from) {
  forget(std::numeric_limits<std::int64_t>::max());  // the room stays
  take_bytes(from, forgotten_);
  const auto place = [](const TrackPoint& p) { return std::pair(p.frame, p.track_id); };
  TrackPoint point, before;
  for (std::size_t left = from.count(), first = left; left > 0; --left, before = point) {
    take_bytes(from, point);
    require_frame_number(point.frame);
    require_bytes(left == first || place(before) < place(point),
                  "points of tracks are not in order");
    put(point);
  }
}

void TrackTable::confirm(std::int64_t track_id, std::int64_t frame, double existence) {
  for (std::size_t i = lower_bound(frame); i < frames_.size(); ++i) {
    const std::size_t node = find(frames_[i], track_id).node;
    if (node == kNone) continue;
    TrackPoint& point = nodes_[node].point;
    if (point.status != TrackStatus::tentative || point.existence < existence) continue;
    point.status = TrackStatus::confirmed;
  }
}

void TrackLog::set_mode_names(std::vector<std::string> names) {
  if (names.size() > kMostModes) {
    throw std::invalid_argument("a track log holds at most 8 motion models, got " +
                                std::to_string(names.size()));
  }
  mode_names_ = std::move(names);
}

void TrackLog::reserve(std::size_t points) {
  online_.reserve(points);
  revised_.reserve(points);
}

void TrackLog::report(const TrackPoint& point) {
  online_.put(point);
  revised_.put(point);
}

std::vector<TrackPoint> TrackLog::online() const { return all_points(online_); }

std::vector<TrackPoint> TrackLog::revised() const { return all_points(revised_); }

std::vector<TrackPoint> TrackLog::at(std::int64_t frame) const {
  std::vector<TrackPoint> points;
  at(frame, points);
  return points;
}

void TrackLog::at(std::int64_t frame, std::vector<TrackPoint>& points) const {
  points.clear();
  online_.at(frame, [&](const TrackPoint& p) { points.push_back(p); });
}

std::string TrackLog::text() const {
  std::string out = "modes";
  for (const std::string& mode : mode_names_) out += ' ' + mode;
  out += "\nonline\n";
  online_.each([&](const TrackPoint& p) { append_point(out, p); });
  out += "revised\n";
  revised_.each([&](const TrackPoint& p) { append_point(out, p); });
  return out;
}

}  // namespace glint
