// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "glint/experiments/run_bytes.hpp"
#include "glint/experiments/runs.hpp"
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

/// f(which, run) for every case and every run of the options: result[which][run]. The one place
/// that experiments run through: it keeps finished runs and spreads them over processes as the
/// options say. Results travel as bytes (run_bytes.hpp), kept or not.
template <class F>
auto run_cases(std::size_t cases, const ExperimentOptions& options, Workers& workers, const F& f) {
  using Result = decltype(f(std::size_t{0}, std::size_t{0}));
  std::vector<std::vector<Result>> by_case(
      cases, std::vector<Result>(static_cast<std::size_t>(options.runs)));
  do_runs(
      cases, options, workers, [&](RunId id) { return run_bytes(f(id.which, id.run)); },
      [&](RunId id, const std::string& bytes) {
        by_case[id.which][id.run] = run_of_bytes<Result>(bytes);
      });
  return by_case;
}

}  // namespace glint
