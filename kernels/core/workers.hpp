// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <memory>

#include "glint/kernels/core/function_ref.hpp"
#include "glint/kernels/core/isa.hpp"

namespace glint {

/// The threads that tbb kernels run on: an arena of the engine's own.
class Workers {
 public:
  /// `threads` <= 0 means as many as the machine has.
  explicit Workers(int threads = 0, Isa isa = best_isa());
  ~Workers();
  int threads() const { return threads_; }
  Isa isa() const { return isa_; }

  /// Runs f() inside the arena. What f throws comes out here.
  void execute(FunctionRef<void()> f);

  /// Calls f(tile) for every tile in [0, tiles), in parallel and in no order. Tiles are fixed by
  /// the caller's problem, never by the thread count, so results can be folded in tile order.
  /// Isolated: a thread that waits here picks up no other stage's work.
  void for_tiles(std::size_t tiles, FunctionRef<void(std::size_t)> f);

 private:
  struct Arena;
  int threads_;
  Isa isa_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace glint
