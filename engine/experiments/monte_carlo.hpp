// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <functional>
#include <mutex>
#include <vector>

#include "glint/kernels/core/workers.hpp"

namespace glint {

/// Calls f(i) for i in [0, jobs) over all workers; results come in the order of i, so whatever is
/// folded from them does not depend on the number of threads. Jobs must not share state.
template <class F>
auto run_jobs(std::size_t jobs, Workers& workers,
              const std::function<void(int done, int total)>& progress, const F& f) {
  std::vector<decltype(f(std::size_t{0}))> results(jobs);
  std::mutex mutex;
  int done = 0;
  workers.for_tiles(jobs, [&](std::size_t i) {
    results[i] = f(i);
    if (!progress) return;
    const std::lock_guard lock(mutex);
    progress(++done, static_cast<int>(jobs));
  });
  return results;
}

}  // namespace glint
