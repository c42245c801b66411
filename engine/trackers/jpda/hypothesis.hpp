// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "glint/engine/filters/imm.hpp"
#include "glint/engine/state/bytes.hpp"

namespace glint {

/// Most scans of a window, the newest included.
inline constexpr int kMostWindowScans = 3;

/// What a target had in each scan of a window before the newest, the oldest first: 0 for none of
/// its points, i + 1 for point i of its gate.
class AssociationHistory {
 public:
  int scans() const { return scans_; }
  /// Throws nothing: there is room for kMostWindowScans - 1.
  void append(std::uint32_t option) { options_[static_cast<std::size_t>(scans_++)] = option; }
  /// Drops the oldest scans until there are at most `scans`.
  void keep_newest(int scans) {
    for (; scans_ > scans; --scans_) std::shift_left(options_.begin(), options_.end(), 1);
  }
  friend bool operator==(const AssociationHistory& a, const AssociationHistory& b) {
    return std::ranges::equal(a.options(), b.options());
  }

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.options_, s.scans_);
  }
  void restored() const {
    require_bytes(scans_ >= 0 && scans_ < kMostWindowScans, "a hypothesis is too long");
  }

 private:
  std::span<const std::uint32_t> options() const {
    return std::span(options_).first(static_cast<std::size_t>(scans_));
  }

  std::array<std::uint32_t, kMostWindowScans - 1> options_{};
  int scans_ = 0;
};

/// One explanation of a target's past in the window, and its motion models given that.
template <int Axes>
struct Hypothesis {
  AssociationHistory history;
  ImmOf<Axes> bank;

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.history, s.bank);
  }
};

/// Appends to `numbers` one a hypothesis of a target: 0, 1, ... in the order in which different
/// histories appear, the same for the same history.
template <int Axes>
void number_histories(std::span<const Hypothesis<Axes>> hypotheses,
                      std::vector<std::uint32_t>& numbers) {
  const std::size_t first = numbers.size();
  std::uint32_t different = 0;
  for (std::size_t h = 0; h < hypotheses.size(); ++h) {
    std::size_t same = 0;
    while (!(hypotheses[same].history == hypotheses[h].history)) ++same;
    numbers.push_back(same < h ? numbers[first + same] : different++);
  }
}

}  // namespace glint
