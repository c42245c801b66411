// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "glint/experiments/experiment.hpp"

namespace glint {

/// One run of an experiment: which of its cases, and which of the seeds.
struct RunId {
  std::uint32_t which = 0, run = 0;
  auto operator<=>(const RunId&) const = default;
};

/// Keeps the results of finished runs, as bytes of run_bytes.hpp, beyond the process.
class RunStore {
 public:
  virtual ~RunStore() = default;
  /// Nothing if the run is not kept.
  virtual std::optional<std::string> find(RunId id) = 0;
  /// One call at a time.
  virtual void keep(RunId id, const std::string& bytes) = 0;
};

using DoRun = std::function<std::string(RunId)>;
using TakeRun = std::function<void(RunId, const std::string& bytes)>;

/// Processes that share the runs of an experiment, each of which calls run_experiment().
class RunTeam {
 public:
  virtual ~RunTeam() = default;
  /// Whether this process takes all results; it alone may have a RunStore.
  virtual bool leads() const = 0;
  /// The leader's `runs`, spread over the workers of all; ends when all are done. `take` is called
  /// at the leader, from any thread, one call at a time, in no order.
  virtual void share(std::span<const RunId> runs, Workers& workers, const DoRun& work,
                     const TakeRun& take) = 0;
};

/// Thrown by run_experiment() in a process of a team that does not lead, once all runs are done.
struct RunsTakenElsewhere {};

/// Calls work(id) for every case of `cases` and run of options.runs, unless options.store has it,
/// and take(id, result) for each, one call at a time, in no order.
void do_runs(std::size_t cases, const ExperimentOptions& options, Workers& workers,
             const DoRun& work, const TakeRun& take);

}  // namespace glint
