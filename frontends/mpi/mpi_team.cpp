// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/mpi/mpi_team.hpp"

#include <cstdlib>

#include "glint/frontends/modules/module.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint::cli {

std::unique_ptr<ProcessTeam> mpi_team() {
  // Set by Open MPI's launcher, and by those of MPICH and Slurm.
  const bool launched =
      std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr || std::getenv("PMI_SIZE") != nullptr;
  if (!launched) return nullptr;
#ifdef GLINT_WITH_MPI
  return static_cast<const MpiFunctions*>(open_module("mpi"))->join();
#else
  throw UsageError(
      "this glint was built without MPI, and cannot share runs; install libopenmpi-dev and build "
      "it again with -DGLINT_WITH_MPI=ON, or start it without mpirun");
#endif
}

}  // namespace glint::cli
