// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/workers.hpp"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

namespace glint {

struct Workers::Arena {
  explicit Arena(int threads) : arena(threads) {}
  tbb::task_arena arena;
};

Workers::Workers(int threads, Isa isa)
    : threads_(threads > 0 ? threads : tbb::info::default_concurrency()),
      isa_(isa),
      arena_(std::make_unique<Arena>(threads_)) {}

Workers::~Workers() = default;

void Workers::execute(FunctionRef<void()> f) {
  arena_->arena.execute([&] { f(); });
}

void Workers::for_tiles(std::size_t tiles, FunctionRef<void(std::size_t)> f) {
  if (tiles <= 1 || threads_ == 1) {
    for (std::size_t t = 0; t < tiles; ++t) f(t);
    return;
  }
  arena_->arena.execute([&] {
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(
          std::size_t{0}, tiles, [&](std::size_t t) { f(t); }, tbb::static_partitioner());
    });
  });
}

}  // namespace glint
