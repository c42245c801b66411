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

/// What is done with MPI, which is a module (frontends/modules/module.hpp).
struct MpiFunctions {
  std::unique_ptr<ProcessTeam> (*join)();  ///< begins MPI; throws std::runtime_error
};

/// Those that mpirun or srun started with this one; nothing for a process by itself, in which MPI
/// is neither loaded nor begun. To be called once. Throws UsageError in a program built without
/// MPI, and std::runtime_error if MPI cannot be opened or begun.
std::unique_ptr<ProcessTeam> mpi_team();

}  // namespace glint::cli
