// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstddef>
#include <tuple>
#include <vector>

#include "glint/engine/state/bytes.hpp"
#include "glint/engine/trackers/jpda/imm_multiscan_jpda.hpp"

namespace glint {

/// WindowReading::restart: all scans of the window are filtered anew at every scan. Keeps these
/// scans, and each target's estimate before the first of them that it was followed in.
template <class Sensor>
class WindowRestarts {
 public:
  using Bank = ImmOf<Sensor::kAxes>;
  using Scan = SensorScan<Sensor>;

  /// `window`: scans, the newest included.
  explicit WindowRestarts(int window) : window_(static_cast<std::size_t>(window)) {}

  void add(const Bank& bank) { estimates_.push_back({bank}); }
  void remove(std::size_t target) {
    estimates_.erase(estimates_.begin() + static_cast<std::ptrdiff_t>(target));
  }
  std::size_t targets() const { return estimates_.size(); }
  /// After the newest scan, or as it was added since.
  const Bank& estimate(std::size_t target) const { return estimates_[target].back(); }

  /// Filters the scans of the window and the newest with `filter`, whose own targets are removed,
  /// before and afterwards.
  MultiscanReport process(ImmMultiscanJpda<Sensor>& filter, const Scan& newest);

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.scans_, s.estimates_);
  }
  void restored() const;
  void require_alike(const Bank& bank) const;

 private:
  void keep(const ImmMultiscanJpda<Sensor>& filter, const Scan& newest);

  std::size_t window_;
  std::vector<Scan> scans_;                   // before the newest, which comes last
  std::vector<std::vector<Bank>> estimates_;  // by target: before each of its scans, and the newest
};

template <class Sensor>
MultiscanReport WindowRestarts<Sensor>::process(ImmMultiscanJpda<Sensor>& filter,
                                                const Scan& newest) {
  MultiscanReport report;
  filter.clear();
  for (std::size_t left = scans_.size() + 1; left > 0; --left) {
    // Older targets have lower numbers, so that targets have the same numbers in the filter.
    for (const std::vector<Bank>& before : estimates_) {
      if (before.size() == left) filter.add(before.front());
    }
    report = filter.process(left > 1 ? scans_[scans_.size() + 1 - left] : newest);
    if (left > 1) filter.advance();
  }
  keep(filter, newest);
  filter.clear();
  return report;
}

template <class Sensor>
void WindowRestarts<Sensor>::keep(const ImmMultiscanJpda<Sensor>& filter, const Scan& newest) {
  for (std::size_t t = 0; t < targets(); ++t) {
    std::vector<Bank>& own = estimates_[t];
    own.push_back(filter.estimate(t));
    if (own.size() > window_) own.erase(own.begin());
  }
  if (scans_.size() + 1 < window_) {
    scans_.push_back(newest);
  } else if (window_ > 1) {
    std::rotate(scans_.begin(), scans_.begin() + 1, scans_.end());
    scans_.back() = newest;
  }
}

template <class Sensor>
void WindowRestarts<Sensor>::restored() const {
  require_bytes(scans_.size() < window_, "a window has too many scans");
  std::size_t most = scans_.size() + 1;
  for (const std::vector<Bank>& own : estimates_) {
    require_bytes(!own.empty() && own.size() <= most, "a target is not whole");
    most = own.size();
  }
}

template <class Sensor>
void WindowRestarts<Sensor>::require_alike(const Bank& bank) const {
  for (const std::vector<Bank>& own : estimates_) {
    const bool all = std::ranges::all_of(own, [&](const Bank& b) { return b.alike(bank); });
    require_bytes(all, "a target moves by other models");
  }
}

}  // namespace glint
