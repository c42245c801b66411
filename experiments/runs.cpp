// SPDX-License-Identifier: Apache-2.0
#include "glint/experiments/runs.hpp"

#include <mutex>
#include <vector>

namespace glint {
namespace {

/// Runs are outermost, so that threads share slow and fast cases evenly.
std::vector<RunId> all_runs(std::size_t cases, int runs) {
  std::vector<RunId> all;
  all.reserve(cases * static_cast<std::size_t>(runs));
  for (std::uint32_t run = 0; run < static_cast<std::uint32_t>(runs); ++run) {
    for (std::uint32_t which = 0; which < cases; ++which) all.push_back({which, run});
  }
  return all;
}

void share_alone(std::span<const RunId> runs, Workers& workers, const DoRun& work,
                 const TakeRun& take) {
  std::mutex mutex;
  workers.for_tiles(runs.size(), [&](std::size_t i) {
    const std::string bytes = work(runs[i]);
    const std::lock_guard lock(mutex);
    take(runs[i], bytes);
  });
}

}  // namespace

void do_runs(std::size_t cases, const ExperimentOptions& options, Workers& workers,
             const DoRun& work, const TakeRun& take) {
  const std::vector<RunId> all = all_runs(cases, options.runs);
  int done = 0;
  const auto finish = [&](RunId id, const std::string& bytes) {
    take(id, bytes);
    if (options.progress) options.progress(++done, static_cast<int>(all.size()));
  };
  std::vector<RunId> missing;
  for (const RunId id : all) {
    const auto kept = options.store != nullptr ? options.store->find(id) : std::nullopt;
    kept ? finish(id, *kept) : missing.push_back(id);
  }
  const auto keep = [&](RunId id, const std::string& bytes) {
    if (options.store != nullptr) options.store->keep(id, bytes);
    finish(id, bytes);
  };
  if (options.team == nullptr) return share_alone(missing, workers, work, keep);
  options.team->share(missing, workers, work, keep);
  if (!options.team->leads()) throw RunsTakenElsewhere();
}

}  // namespace glint
