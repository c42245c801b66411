// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/parity.hpp"

#include <fmt/core.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "glint/engine/scenario/scenes.hpp"
#include "glint/experiments/log_parity.hpp"
#include "glint/frontends/cli/commands.hpp"
#include "glint/kernels/all.hpp"

namespace glint::cli {
namespace {

struct ParityRequest {
  std::string device = "auto";
  bool json = false;
};

/// What all trials of a kernel on all devices come to.
struct KernelSummary {
  std::size_t trials = 0;
  double worst = 0;  ///< over the tolerance
  bool ok = true;
};

KernelSummary summary_of(const std::vector<ParityRow>& rows) {
  KernelSummary sum;
  std::set<std::string> trials;
  for (const ParityRow& row : rows) {
    trials.insert(row.trial);
    sum.worst = std::max(sum.worst, row.worst);
    sum.ok = sum.ok && row.ok();
  }
  sum.trials = trials.size();
  return sum;
}

const char* verdict(bool ok) { return ok ? "ok" : "FAILED"; }

void print_kernel(const std::string& name, const std::vector<ParityRow>& rows,
                  std::size_t devices) {
  const KernelSummary sum = summary_of(rows);
  fmt::print("{:<22}{:>8}{:>9}{:>18.3g}   {}\n", name, sum.trials, devices, sum.worst,
             verdict(sum.ok));
  for (const ParityRow& row : rows) {
    if (!row.ok()) fmt::print("  {}\n", description(row));
  }
}

void print_log(const LogParityRow& row) {
  fmt::print("{:<16}{:<12}{:<28}{:>8}   {}\n", row.tracker, row.scene, row.device, row.points,
             verdict(row.ok()));
  if (row.first_other_line > 0) fmt::print("  first other line: {}\n", row.first_other_line);
  if (row.points == 0) fmt::print("  the log is empty\n");
}

nlohmann::ordered_json to_json(const std::optional<Mismatch>& m) {
  if (!m) return nullptr;
  return {{"output", m->output}, {"index", m->index}, {"want", m->want}, {"got", m->got}};
}

nlohmann::ordered_json to_json(const ParityRow& row) {
  return {{"kernel", row.kernel},
          {"trial", row.trial},
          {"device", row.device},
          {"worst_over_tolerance", row.worst},  // null where it is infinite
          {"ok", row.ok()},
          {"outside", to_json(row.outside)},
          {"other_bits", to_json(row.other_bits)}};
}

nlohmann::ordered_json to_json(const LogParityRow& row) {
  return {{"tracker", row.tracker}, {"scene", row.scene},
          {"device", row.device},   {"points", row.points},
          {"ok", row.ok()},         {"first_other_line", row.first_other_line}};
}

/// The devices that a track log must not depend on.
std::vector<Device> log_devices(const Device& device) {
  if (device.kind() != DeviceKind::tbb) return {device, device};
  std::vector<Device> devices;
  for (const int threads : {1, 2, 3, 8}) devices.push_back(Device::tbb(threads));
  return devices;
}

Scene log_scene(const Device& device) {
  if (device.kind() != DeviceKind::tbb) return make_scene(CrossingScene{});
  IrClipScene clip;  // of many tiles
  clip.frames = 20;
  return make_scene(clip);
}

Device device_named(const std::string& name) {
  try {
    return Device::named(name);
  } catch (const std::invalid_argument& e) {
    throw UsageError(e.what());
  }
}

/// What was found so far; prints each finding at once unless all goes into JSON.
struct Report {
  bool json = false, ok = true;
  nlohmann::ordered_json kernels = nlohmann::ordered_json::array();
  nlohmann::ordered_json logs = nlohmann::ordered_json::array();
};

void check_kernels(const Device& device, Report& report) {
  const std::vector<Device> devices = parity_devices(device);
  if (!report.json) {
    fmt::print("{:<22}{:>8}{:>9}{:>18}   {}\n", "kernel", "trials", "devices", "error/tolerance",
               "verdict");
  }
  for (const KernelEntry& kernel : all_kernels()) {
    const std::vector<ParityRow> rows = check_parity(kernel, devices);
    report.ok = report.ok && summary_of(rows).ok;
    if (!report.json) print_kernel(std::string(kernel.name), rows, devices.size());
    for (const ParityRow& row : rows) report.kernels.push_back(to_json(row));
  }
}

void check_logs(const Device& device, Report& report) {
  if (!report.json) {
    fmt::print("\n{:<16}{:<12}{:<28}{:>8}   {}\n", "tracker", "scene", "device", "points",
               "same log");
  }
  const Scene scene = log_scene(device);
  const std::vector<Device> devices = log_devices(device);
  for (const TrackerEntry& tracker : all_trackers()) {
    for (const LogParityRow& row : check_log_parity(tracker, scene, 1, devices)) {
      report.ok = report.ok && row.ok();
      if (!report.json) print_log(row);
      report.logs.push_back(to_json(row));
    }
  }
}

void print_parity(const ParityRequest& request) {
  const Device device = device_named(request.device);
  // Eight threads on machines with fewer cores; a tool may do that, the library may not.
  const tbb::global_control eight(tbb::global_control::max_allowed_parallelism, 8);
  Report report;
  report.json = request.json;
  check_kernels(device, report);
  check_logs(device, report);
  if (report.json) {
    const nlohmann::ordered_json all{
        {"ok", report.ok}, {"kernels", report.kernels}, {"logs", report.logs}};
    fmt::print("{}\n", all.dump());
  }
  if (!report.ok) throw std::runtime_error("results depend on the device; see what FAILED");
}

}  // namespace

void add_parity(Command& program) {
  Command command = program.subcommand(kParity.name, kParity.description);
  const auto request = std::make_shared<ParityRequest>();
  command.option("--device", request->device, "auto, serial, tbb, egl or egl:N").with_default();
  command.flag("--json", request->json, "print every trial on every device as JSON");
  command.footer(
      "Every trial of every kernel must be inside its declared tolerance of the serial reference,\n"
      "with the same bits on 1, 2, 3 and 8 threads and every instruction set; track logs must be\n"
      "equal byte for byte. egl repeats itself, and runs on tbb what it has no shader for (see "
      "glint\n"
      "info). Exit code 1 if anything is not equal.\n"
      "Examples:\n"
      "  glint parity\n"
      "  glint parity --device tbb --json\n"
      "  glint parity --device egl");
  command.callback([request] { print_parity(*request); });
}

}  // namespace glint::cli
