// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <string>

#include "glint/engine/trackers/registry.hpp"
#include "glint/frontends/cli/commands.hpp"
#include "glint/kernels/all.hpp"
#include "glint/kernels/core/device.hpp"

namespace glint::cli {
namespace {

std::string isas() {
  std::string list;
  for (const Isa isa : runnable_isas()) list += (list.empty() ? "" : " ") + std::string(name(isa));
  return list;
}

void print_info() {
  fmt::print("glint {} ({} build)\n", GLINT_VERSION, GLINT_BUILD_TYPE);
  fmt::print("instruction sets  {} (best: {})\n", isas(), name(best_isa()));
  fmt::print("devices           {}\n", Device::serial().description());
  fmt::print("                  {} (auto)\n", Device::tbb().description());
  fmt::print("kernels          ");
  for (const KernelEntry& kernel : all_kernels()) fmt::print(" {}", kernel.name);
  fmt::print("\ntrackers\n");
  for (const TrackerEntry& t : all_trackers()) fmt::print("  {:<16}{}\n", t.name, t.summary);
}

}  // namespace

void add_info(CLI::App& app) {
  CLI::App* command = app.add_subcommand("info", "Version, build, devices, kernels, trackers");
  command->footer("Example:\n  glint info");
  command->callback(print_info);
}

}  // namespace glint::cli
