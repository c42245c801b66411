// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/limits.hpp"

#include <cstring>

#include "glint/bench/limits_lanes.hpp"
#include "glint/kernels/core/tiles.hpp"

namespace glint::bench {
namespace {

// f(begin, n) over fixed tiles of whole cache lines; a last part of less than 64 elements is left
// out, it does not show in a rate.
template <class F>
void over_tiles(Workers& workers, std::size_t count, const F& f) {
  const Tiles tiles{count / 64 * 64, std::size_t{1} << 16};
  workers.for_tiles(tiles.tiles(), [&](std::size_t t) {
    f(tiles.begin(t), static_cast<int>(tiles.end(t) - tiles.begin(t)));
  });
}

}  // namespace

void stream_copy(Workers& workers, std::span<const float> from, std::span<float> to) {
  const LimitLanes& lanes = limit_lanes(workers.isa());
  over_tiles(workers, from.size(), [&](std::size_t at, int n) {
    lanes.stream_copy(from.data() + at, to.data() + at, n);
  });
}

void stream_widen(Workers& workers, std::span<const std::uint16_t> from, std::span<float> to) {
  const LimitLanes& lanes = limit_lanes(workers.isa());
  over_tiles(workers, from.size(), [&](std::size_t at, int n) {
    lanes.stream_widen(from.data() + at, to.data() + at, n);
  });
}

void read(Workers& workers, std::span<const float> from) {
  const LimitLanes& lanes = limit_lanes(workers.isa());
  over_tiles(workers, from.size(), [&](std::size_t at, int n) { lanes.read(from.data() + at, n); });
}

void scale_in_place(Workers& workers, std::span<float> values) {
  const LimitLanes& lanes = limit_lanes(workers.isa());
  over_tiles(workers, values.size(),
             [&](std::size_t at, int n) { lanes.scale_in_place(values.data() + at, n); });
}

void combine(Workers& workers, std::span<const float> a, std::span<const float> b,
             std::span<const float> c, std::span<float> to) {
  const LimitLanes& lanes = limit_lanes(workers.isa());
  over_tiles(workers, to.size(), [&](std::size_t at, int n) {
    lanes.combine(a.data() + at, b.data() + at, c.data() + at, to.data() + at, n);
  });
}

void copy(Workers& workers, std::span<const float> from, std::span<float> to) {
  over_tiles(workers, from.size(), [&](std::size_t at, int n) {
    std::memcpy(to.data() + at, from.data() + at, static_cast<std::size_t>(n) * sizeof(float));
  });
}

}  // namespace glint::bench
