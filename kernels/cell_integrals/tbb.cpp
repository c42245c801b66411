// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "glint/kernels/cell_integrals/lanes.hpp"
#include "glint/kernels/cell_integrals/neighbours.hpp"
#include "glint/kernels/core/tiles.hpp"

namespace glint {
namespace {

using cell_integrals::PartialSums;
using Args = CellIntegrals::Args;

/// Targets a tile, about 10 us.
constexpr std::size_t kTargetTile = 64;
/// Fewer tiles are done before a second thread has woken up for each of the four passes.
constexpr std::size_t kLeastSharedTiles = 8;
/// Tiles a round and thread.
constexpr std::size_t kRoundTiles = 16;

LaneCells lane_cells(FrameView frame, const CellRule& rule) {
  return {.data = frame.data,
          .pitch = frame.pitch,
          .width = frame.width,
          .height = frame.height,
          .threshold = rule.threshold,
          .offset = rule.subtract ? rule.threshold : 0,
          .background = 0,
          .truncate_dark = rule.truncate_dark,
          .log_likelihood = false,
          .missing = rule.missing.data(),
          .missing_count = rule.missing.size()};
}

/// What one tile of targets keeps: which of them are alone, and for the others who is near and the
/// integrals of their axes.
struct TargetTile {
  struct Crowded {
    std::uint32_t target;
    std::size_t first_neighbour, neighbours;
  };
  std::vector<std::uint32_t> isolated, neighbours;
  std::vector<Crowded> crowded;
  std::vector<LaneNeighbour> at_hand;
  double log_ratio_sum = 0;
};

}  // namespace

struct IntegralsWorkspace::Fast {
  std::vector<LaneTarget> located, targets;  ///< as they come, and sorted by the grid
  std::vector<TargetProfile> profiles;
  std::vector<PartialSums> partial;
  std::vector<TargetTile> tiles;
  std::vector<std::vector<float>> profile_storage;  ///< a ring, by tile
  cell_integrals::Grid grid;

  std::vector<float>& storage_of(std::size_t tile) {
    return profile_storage[tile % profile_storage.size()];
  }
};
IntegralsWorkspace::IntegralsWorkspace() = default;
IntegralsWorkspace::~IntegralsWorkspace() = default;
IntegralsWorkspace::IntegralsWorkspace(IntegralsWorkspace&&) noexcept = default;
IntegralsWorkspace& IntegralsWorkspace::operator=(IntegralsWorkspace&&) noexcept = default;

namespace {

using Space = IntegralsWorkspace::Fast;

bool fits_registers(const Box& box) {
  return box.x1 - box.x0 <= kIsolatedSide && box.y1 - box.y0 <= kIsolatedSide;
}

/// Splits a tile into targets that are alone and others, whose axes are integrated here.
void survey(const CellIntegralsLanes& lanes, const LaneCells& cells, Space& space, TargetTile& tile,
            std::vector<float>& profiles, std::size_t begin, std::size_t end) {
  tile.isolated.clear(), tile.neighbours.clear(), tile.crowded.clear();
  const bool plain = !cells.log_likelihood && !cells.truncate_dark && cells.missing_count == 0;
  std::size_t floats = 0;
  for (std::size_t k = begin; k < end; ++k) {
    const std::size_t first = tile.neighbours.size();
    space.grid.each_neighbour(space.targets, k,
                              [&](std::uint32_t j) { tile.neighbours.push_back(j); });
    const std::size_t count = tile.neighbours.size() - first;
    const auto target = static_cast<std::uint32_t>(k);
    if (plain && count == 0 && fits_registers(space.targets[k].box)) {
      tile.isolated.push_back(target);
    } else {
      tile.crowded.push_back({target, first, count});
      floats += profile_size(space.targets[k].box);
    }
  }
  profiles.resize(floats);
  float* storage = profiles.data();
  for (const TargetTile::Crowded& c : tile.crowded) {
    space.profiles[c.target] = lanes.profile(space.targets[c.target], storage);
    storage += profile_size(space.targets[c.target].box);
  }
}

void sum_tile(const CellIntegralsLanes& lanes, const LaneCells& cells, Space& space,
              TargetTile& tile) {
  lanes.isolated(cells, space.targets.data(), tile.isolated.data(), tile.isolated.size(),
                 space.partial.data());
  tile.log_ratio_sum = 0;
  for (std::size_t at = 0; at < tile.crowded.size(); ++at) {
    const TargetTile::Crowded& c = tile.crowded[at];
    const bool is_last = at + 1 == tile.crowded.size();
    tile.at_hand.clear();
    for (std::size_t i = 0; i < c.neighbours; ++i) {
      const std::uint32_t j = tile.neighbours[c.first_neighbour + i];
      tile.at_hand.push_back({&space.targets[j], space.profiles[j], j < c.target});
    }
    lanes.crowded(cells, space.targets[c.target], space.profiles[c.target], tile.at_hand.data(),
                  c.neighbours, is_last ? nullptr : &space.targets[tile.crowded[at + 1].target],
                  space.partial[space.targets[c.target].index], tile.log_ratio_sum);
  }
}

/// Tiles [begin, end) that are summed together, and those whose targets may be near theirs.
struct Round {
  std::size_t begin, end, near_begin, near_end;
};
Round round_at(const Space& space, const Tiles& split, std::size_t begin, std::size_t length) {
  if (split.tiles() == 1) return {0, 1, 0, 1};
  const std::size_t end = std::min(begin + length, split.tiles());
  const auto near = space.grid.around(space.targets, split.begin(begin), split.end(end - 1));
  return {begin, end, near.first / split.size, (near.end + split.size - 1) / split.size};
}

/// Surveys and sums all tiles, a few at a time: the integrals of their axes, far more than a cache
/// holds for all targets, are made just before they are used and in memory that is used again.
template <class ForTiles>
void sum_in_rounds(const CellIntegralsLanes& lanes, const LaneCells& cells, Space& space,
                   const Tiles& split, std::size_t length, const ForTiles& for_tiles) {
  std::size_t at_once = 1;
  for (std::size_t t = 0; t < split.tiles(); t += length) {
    const Round round = round_at(space, split, t, length);
    at_once = std::max(at_once, round.near_end - round.near_begin);
  }
  if (space.profile_storage.size() < at_once) space.profile_storage.resize(at_once);
  std::size_t surveyed = 0;
  for (std::size_t t = 0; t < split.tiles(); t += length) {
    const Round round = round_at(space, split, t, length);
    for_tiles(surveyed, round.near_end, [&](std::size_t i) {
      survey(lanes, cells, space, space.tiles[i], space.storage_of(i), split.begin(i),
             split.end(i));
    });
    surveyed = std::max(surveyed, round.near_end);
    for_tiles(round.begin, round.end,
              [&](std::size_t i) { sum_tile(lanes, cells, space, space.tiles[i]); });
  }
}

Space& space_of(IntegralsWorkspace& workspace, std::size_t targets, std::size_t tiles) {
  if (!workspace.fast) workspace.fast = std::make_unique<Space>();
  Space& space = *workspace.fast;
  space.located.resize(targets);
  space.profiles.resize(targets);
  space.partial.resize(targets);
  if (space.tiles.size() < tiles) space.tiles.resize(tiles);
  return space;
}

/// Adds z over the pixels of row `y` that no box hides.
void sum_row(const CellIntegralsLanes& lanes, const LaneCells& cells, int y,
             std::vector<std::pair<int, int>>& hidden, CellTotal& total) {
  hidden.clear();
  for (std::size_t i = 0; i < cells.missing_count; ++i) {
    const Box& box = cells.missing[i];
    if (y >= box.y0 && y < box.y1) hidden.emplace_back(box.x0, box.x1);
  }
  std::sort(hidden.begin(), hidden.end());
  const float* const row = cells.data + y * cells.pitch;
  int x = 0;
  const auto sum_to = [&](int end) {
    if (end > x) lanes.sum(cells, row + x, end - x, 1, total.norm, total.shown);
  };
  for (const auto& [begin, end] : hidden) {
    sum_to(std::min(begin, cells.width));
    x = std::max(x, end);
  }
  sum_to(cells.width);
}

}  // namespace

void SumCells::tbb(const Args& args, Workers& workers) {
  const CellIntegralsLanes& lanes = cell_integrals_lanes(workers.isa());
  const LaneCells cells = lane_cells(args.frame, args.rule);
  const Tiles rows{args.frame.empty() ? 0 : static_cast<std::size_t>(args.frame.height), kRowTile};
  std::vector<CellTotal> totals(rows.tiles());
  workers.for_tiles(rows.tiles(), [&](std::size_t t) {
    if (cells.missing_count == 0) {
      const auto begin = static_cast<int>(rows.begin(t)), end = static_cast<int>(rows.end(t));
      return lanes.sum(cells, cells.data + begin * cells.pitch, cells.width, end - begin,
                       totals[t].norm, totals[t].shown);
    }
    std::vector<std::pair<int, int>> hidden;
    for (std::size_t y = rows.begin(t); y < rows.end(t); ++y) {
      sum_row(lanes, cells, static_cast<int>(y), hidden, totals[t]);
    }
  });
  *args.total = {};
  for (const CellTotal& t : totals) {
    args.total->norm += t.norm;
    args.total->shown += t.shown;
  }
}

void CellIntegrals::tbb(const Args& args, Workers& workers) {
  cell_integrals::check(args);
  const Tiles split{args.targets.size(), kTargetTile};
  IntegralsWorkspace own;
  Space& space = space_of(args.workspace != nullptr ? *args.workspace : own, args.targets.size(),
                          split.tiles());
  const CellIntegralsLanes& lanes = cell_integrals_lanes(workers.isa());
  LaneCells cells = lane_cells(args.frame, args.rule);
  cells.background = static_cast<float>(args.background / cell_integrals::cells_of(args));
  cells.log_likelihood = args.log_likelihood;
  const auto for_tiles = [&](std::size_t begin, std::size_t end, const auto& f) {
    if (split.tiles() >= kLeastSharedTiles && end > begin + 1) {
      return workers.for_tiles(end - begin, [&](std::size_t t) { f(begin + t); });
    }
    for (std::size_t t = begin; t < end; ++t) f(t);
  };
  for_tiles(0, split.tiles(), [&](std::size_t t) {
    lanes.locate(args.targets.data(), split.begin(t), split.end(t), args.reach, args.frame.width,
                 args.frame.height, space.located.data());
  });
  space.grid.sort(space.located, args.frame.width, args.frame.height, space.targets);
  const auto threads = static_cast<std::size_t>(workers.threads());
  sum_in_rounds(lanes, cells, space, split, kRoundTiles * threads, for_tiles);
  const cell_integrals::Totals totals = cell_integrals::totals_of(args, space.partial);
  for_tiles(0, split.tiles(), [&](std::size_t t) {
    for (std::size_t k = split.begin(t); k < split.end(t); ++k) {
      args.sums[k] =
          cell_integrals::normalised(args.targets[k], space.partial[k], totals.missing_weight);
    }
  });
  double log_ratio_sum = 0;
  for (std::size_t t = 0; t < split.tiles(); ++t) log_ratio_sum += space.tiles[t].log_ratio_sum;
  cell_integrals::fill_mixture(args, totals, log_ratio_sum);
}

}  // namespace glint
