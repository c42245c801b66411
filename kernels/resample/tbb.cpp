// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "glint/kernels/core/workers.hpp"
#include "glint/kernels/resample/check.hpp"
#include "glint/kernels/resample/lanes.hpp"

namespace glint {
namespace {

using resample::kBlock;
using resample::kUnit;
using resample::Rule;
using resample::Sums;

/// One call: the problem and where its passes run.
class Drawing {
 public:
  Drawing(const Resample::Args& args, ResampleWorkspace& space, Workers& workers)
      : args_(args),
        space_(space),
        workers_(workers),
        lanes_(resample_lanes(workers.isa())),
        blocks_{args.weights.size(), kBlock} {}

  void run() {
    space_.blocks.resize(blocks_.tiles() + 1);
    set_rule();
    plan_units();
    each(space_.units.size(), [&](std::size_t u) { draw(space_.units[u]); });
  }

 private:
  template <class F>
  void each(std::size_t count, const F& f) {
    constexpr std::size_t kWorthThreads = 32768;  // about 20 us of the cheapest pass
    if (args_.weights.size() + args_.ancestors.size() >= kWorthThreads) {
      return workers_.for_tiles(count, f);
    }
    for (std::size_t i = 0; i < count; ++i) f(i);
  }

  const float* weights(std::size_t block) const {
    return args_.weights.data() + blocks_.begin(block);
  }
  std::size_t size(std::size_t block) const { return blocks_.end(block) - blocks_.begin(block); }

  /// Sums of every block by `sums_of`, then turned into the sums before it; returns those of all.
  template <class F>
  Sums scan(const F& sums_of) {
    each(blocks_.tiles(), [&](std::size_t b) {
      const Sums sums = sums_of(b);
      space_.blocks[b] = {sums.copies, sums.mass, 0};
    });
    Sums before;
    for (std::size_t b = 0; b < blocks_.tiles(); ++b) {
      ResampleWorkspace::Block& block = space_.blocks[b];
      const Sums sums{block.copies, block.mass};
      block.copies = before.copies;
      block.mass = before.mass;
      before.copies += sums.copies;
      before.mass += sums.mass;
    }
    space_.blocks.back() = {before.copies, before.mass, 0};
    return before;
  }

  float largest() {
    each(blocks_.tiles(), [&](std::size_t b) {
      space_.blocks[b].begin = math::bits(lanes_.largest(weights(b), size(b)));
    });
    std::int32_t bits = 0;
    for (std::size_t b = 0; b < blocks_.tiles(); ++b) bits = std::max(bits, space_.blocks[b].begin);
    return math::from_bits(bits);
  }

  void set_rule() {
    const std::size_t count = args_.ancestors.size();
    const int bits = resample::bits(args_.weights.size(), count);
    rule_.scale = resample::scale_of(largest(), bits);
    Sums all = scan([&](std::size_t b) {
      return Sums{0, lanes_.total(weights(b), size(b), rule_.scale)};
    });
    if (args_.method == Resampling::residual) {
      rule_.splits = true;
      rule_.splitter = resample::splitter_of(static_cast<double>(all.mass), count, bits);
      all = scan([&](std::size_t b) { return lanes_.split_totals(weights(b), size(b), rule_); });
    }
    const std::uint32_t word = random_words(args_.key, 0).w[0];
    const auto drawn = static_cast<double>(static_cast<std::int64_t>(count) - all.copies);
    rule_.points = resample::points_of(static_cast<double>(all.mass), drawn, word);
  }

  void plan_units() {
    space_.units.clear();
    for (ResampleWorkspace::Block& b : space_.blocks) {
      b.begin = resample::offspring({b.copies, b.mass}, rule_.points);
    }
    for (std::size_t b = 0; b < blocks_.tiles(); ++b) {
      const auto offspring =
          static_cast<std::size_t>(space_.blocks[b + 1].begin - space_.blocks[b].begin);
      const Tiles pieces{offspring, kUnit};
      for (std::uint32_t piece = 0; piece < pieces.tiles(); ++piece) {
        space_.units.push_back({static_cast<std::uint32_t>(b), piece});
      }
    }
  }

  void draw(ResampleWorkspace::Unit unit) {
    const ResampleWorkspace::Block &block = space_.blocks[unit.block],
                                   &next = space_.blocks[unit.block + 1];
    const auto begin = block.begin + static_cast<std::int32_t>(unit.piece * kUnit);
    lanes_.draw(rule_, {weights(unit.block),
                        blocks_.begin(unit.block),
                        size(unit.block),
                        {block.copies, block.mass},
                        begin,
                        std::min(next.begin, begin + static_cast<std::int32_t>(kUnit)),
                        args_.ancestors.data(),
                        args_.moved.data(),
                        args_.moved.size()});
  }

  const Resample::Args& args_;
  ResampleWorkspace& space_;
  Workers& workers_;
  const ResampleLanes& lanes_;
  Tiles blocks_;
  Rule rule_;
};

}  // namespace

void Resample::tbb(const Args& args, Workers& workers) {
  resample::check(args);
  ResampleWorkspace own;
  Drawing(args, args.workspace ? *args.workspace : own, workers).run();
}

}  // namespace glint
