// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <cstddef>

#include "glint/kernels/core/isa.hpp"

namespace glint {

/// The threads that tbb kernels run on: an arena of the engine's own.
class Workers {
 public:
  /// `threads` <= 0 means as many as the machine has.
  explicit Workers(int threads = 0, Isa isa = best_isa());
  int threads() const { return threads_; }
  Isa isa() const { return isa_; }

  /// Runs f() inside the arena.
  template <class F>
  decltype(auto) execute(F&& f) {
    return arena_.execute(std::forward<F>(f));
  }

  /// Calls f(tile) for every tile in [0, tiles), in parallel and in no order. Tiles are fixed by
  /// the caller's problem, never by the thread count, so results can be folded in tile order.
  /// Isolated: a thread that waits here picks up no other stage's work.
  template <class F>
  void for_tiles(std::size_t tiles, const F& f) {
    if (tiles == 0) return;
    if (tiles == 1 || threads_ == 1) {
      for (std::size_t t = 0; t < tiles; ++t) f(t);
      return;
    }
    arena_.execute([&] {
      tbb::this_task_arena::isolate(
          [&] { tbb::parallel_for(std::size_t{0}, tiles, f, tbb::static_partitioner()); });
    });
  }

 private:
  int threads_;
  Isa isa_;
  tbb::task_arena arena_;
};

}  // namespace glint
