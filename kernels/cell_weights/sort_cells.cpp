// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/cell_weights/sort_cells.hpp"

#include <algorithm>

#include "glint/kernels/cell_weights/lanes.hpp"
#include "glint/kernels/core/tiles.hpp"

namespace glint::cell_weights {
namespace {

/// Chunks with counters of their own: few, so that the counters stay small beside the particles.
Tiles chunks_of(std::size_t count) {
  constexpr std::size_t kSmallest = 65536, kMost = 16;
  return {count, std::max(kSmallest, (count + kMost - 1) / kMost)};
}

/// One stable counting sort of words by `digit`; item(k) is what moves along with word k.
template <class Digit, class Item>
void counting_sort(Tiles chunks, std::size_t bins, const Passes& passes, Digit digit, Item item,
                   const std::uint32_t* words, std::uint32_t* sorted_words,
                   std::uint32_t* sorted_items, std::vector<std::uint32_t>& counts) {
  counts.assign(chunks.tiles() * bins, 0);
  passes.each(chunks.tiles(), [&](std::size_t c) {
    std::uint32_t* const count = counts.data() + c * bins;
    for (std::size_t k = chunks.begin(c); k < chunks.end(c); ++k) ++count[digit(words[k])];
  });
  std::uint32_t before = 0;
  for (std::size_t bin = 0; bin < bins; ++bin) {
    for (std::size_t c = 0; c < chunks.tiles(); ++c) {
      const std::uint32_t count = counts[c * bins + bin];
      counts[c * bins + bin] = before;
      before += count;
    }
  }
  passes.each(chunks.tiles(), [&](std::size_t c) {
    std::uint32_t* const next = counts.data() + c * bins;
    for (std::size_t k = chunks.begin(c); k < chunks.end(c); ++k) {
      const std::uint32_t word = words[k], to = next[digit(word)]++;
      sorted_words[to] = word;
      sorted_items[to] = item(k);
    }
  });
}

/// Runs of equal words among `count` sorted ones.
void find_runs(std::size_t count, int width, const std::uint32_t* words, const Passes& passes,
               CellWorkspace& space) {
  const Tiles tiles{count, kParticleTile};
  const auto starts = [&](std::size_t k) { return k == 0 || words[k] != words[k - 1]; };
  space.counts.assign(tiles.tiles() + 1, 0);
  passes.each(tiles.tiles(), [&](std::size_t t) {
    std::uint32_t runs = 0;
    for (std::size_t k = tiles.begin(t); k < tiles.end(t); ++k) runs += starts(k) ? 1u : 0u;
    space.counts[t + 1] = runs;
  });
  for (std::size_t t = 0; t < tiles.tiles(); ++t) space.counts[t + 1] += space.counts[t];
  const std::size_t runs = space.counts.back();
  space.runs.cell.resize(runs);
  space.runs.first.resize(runs + 1);
  passes.each(tiles.tiles(), [&](std::size_t t) {
    std::uint32_t r = space.counts[t];
    for (std::size_t k = tiles.begin(t); k < tiles.end(t); ++k) {
      if (!starts(k)) continue;
      space.runs.cell[r] =
          (words[k] >> kRowShift) * static_cast<std::uint32_t>(width) + (words[k] & kColumnMask);
      space.runs.first[r++] = static_cast<std::uint32_t>(k);
    }
  });
  space.runs.first[runs] = static_cast<std::uint32_t>(count);
}

}  // namespace

std::size_t sort_cells(std::size_t count, int width, int height, const Passes& passes,
                       CellWorkspace& space) {
  const auto columns = static_cast<std::size_t>(width) + 1;  // one more for those outside
  space.scratch.resize(count);
  space.indices.resize(count);
  const Tiles chunks = chunks_of(count);
  counting_sort(
      chunks, columns, passes, [](std::uint32_t word) { return word & kColumnMask; },
      [](std::size_t k) { return static_cast<std::uint32_t>(k); }, space.keys.data(),
      space.scratch.data(), space.indices.data(), space.counts);
  const bool empty = count == 0 || width == 0;
  const std::size_t inside = empty ? 0 : space.counts[(chunks.tiles() - 1) * columns + columns - 2];
  space.runs.order.resize(inside);
  counting_sort(
      chunks_of(inside), static_cast<std::size_t>(height), passes,
      [](std::uint32_t word) { return word >> kRowShift; },
      [&](std::size_t k) { return space.indices[k]; }, space.scratch.data(), space.keys.data(),
      space.runs.order.data(), space.counts);
  find_runs(inside, width, space.keys.data(), passes, space);
  return count - inside;
}

}  // namespace glint::cell_weights
