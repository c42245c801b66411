// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <functional>
#include <mutex>
#include <utility>
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

/// f(which, run) for every case and run: result[which][run]. Runs are outermost, so that threads
/// share slow and fast cases evenly.
template <class F>
auto run_cases(std::size_t cases, std::size_t runs, Workers& workers,
               const std::function<void(int done, int total)>& progress, const F& f) {
  auto jobs = run_jobs(cases * runs, workers, progress,
                       [&](std::size_t job) { return f(job % cases, job / cases); });
  std::vector<decltype(jobs)> by_case(cases);
  for (std::size_t job = 0; job < jobs.size(); ++job) {
    by_case[job % cases].push_back(std::move(jobs[job]));
  }
  return by_case;
}

}  // namespace glint
