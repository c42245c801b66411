// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/mpi/run_exchange.hpp"

extern "C" const void* glint_module() {
  static constexpr glint::cli::MpiFunctions kFunctions{
      .join = []() -> std::unique_ptr<glint::cli::ProcessTeam> {
        return std::make_unique<glint::cli::RunExchange>();
      }};
  return &kFunctions;
}
