// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>

#include "glint/experiments/runs.hpp"

namespace glint::cli {

/// Processes that one launcher started.
class ProcessTeam : public RunTeam {
 public:
  /// Says on standard error which process failed and why, and ends them all with exit code 1.
  virtual void fail(const std::string& why) = 0;
};

/// Those that mpirun or srun started with this one; nothing for a process by itself, in which MPI
/// is never begun. To be called once. Throws UsageError in a program built without MPI.
std::unique_ptr<ProcessTeam> mpi_team();

}  // namespace glint::cli
