// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <string>

#include "glint/engine/scenario/radar_scenes.hpp"
#include "glint/engine/scenario/scenario.hpp"
#include "glint/engine/trackers/registry.hpp"
#include "glint/frontends/cli/commands.hpp"
#include "glint/frontends/modules/video.hpp"
#include "glint/kernels/all.hpp"
#include "glint/kernels/auto_device.hpp"
#include "glint/kernels/core/device.hpp"

namespace glint::cli {
namespace {

std::string isas() {
  std::string list;
  for (const Isa isa : runnable_isas()) list += (list.empty() ? "" : " ") + std::string(name(isa));
  return list;
}

template <class Entries>
void print_entries(const char* title, const Entries& entries) {
  fmt::print("{}\n", title);
  for (const auto& entry : entries) fmt::print("  {:<16}{}\n", entry.name, entry.summary);
}

std::string video_support() {
  if (!has_video()) return "FITS, npy, scenes (built without OpenCV: no video, no images)";
  return "video, images (" + video().video_backends() + "), FITS, npy, scenes";
}

void print_egl_devices() {
  const EglDevices egl = egl_devices();
  for (const EglDevice& device : egl.devices) fmt::print("{:18}{}\n", "", description(device));
  if (egl.devices.empty()) fmt::print("{:18}{}\n", "", egl.missing);
}

void print_info() {
  fmt::print("glint {} ({} build)\n", GLINT_VERSION, GLINT_BUILD_TYPE);
  fmt::print("instruction sets  {} (best: {})\n", isas(), name(best_isa()));
  fmt::print("threads           {}\n", Device::tbb().workers().threads());
  fmt::print("devices           {}\n", Device::serial().description());
  fmt::print("                  {}\n", Device::tbb().description());
  print_egl_devices();
  const AutoChoice choice = choose_device(0);
  fmt::print("auto              {}: {}\n", name(choice.device.kind()), choice.why);
  fmt::print("kernels          ");
  for (const KernelEntry& kernel : all_kernels()) fmt::print(" {}", kernel.name);
  fmt::print("\n  of them on egl ");
  for (const KernelEntry& kernel : all_kernels()) {
    if (kernel.on_egl) fmt::print(" {}", kernel.name);
  }
  if (!std::ranges::all_of(all_kernels(), &KernelEntry::on_egl)) {
    fmt::print("; an egl device runs the others on tbb");
  }
  fmt::print("\ninputs            {}\n", video_support());
  print_entries("trackers", all_trackers());
  print_entries("scenes", all_scenes());
  print_entries("scenes of points", all_radar_scenes());
  fmt::print("experiments       glint experiment --help lists them\n");
}

}  // namespace

void add_info(Command& program) {
  Command command = program.subcommand("info", "Version, build, devices, kernels, trackers");
  command.footer("Example:\n  glint info");
  command.callback(print_info);
}

}  // namespace glint::cli
