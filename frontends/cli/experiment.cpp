// SPDX-License-Identifier: Apache-2.0
#include "glint/experiments/experiment.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "glint/frontends/cli/commands.hpp"
#include "glint/frontends/cli/curves.hpp"
#include "glint/frontends/cli/run_progress.hpp"
#include "glint/frontends/experiments/recorded.hpp"
#include "glint/frontends/experiments/run_file.hpp"
#include "glint/frontends/mpi/mpi_team.hpp"

namespace glint::cli {
namespace {

struct ExperimentRequest {
  std::string name, out, keep, device = "auto";
  ExperimentOptions options;
  int threads = 0;
  bool json = false;
};

std::string end_of(const std::optional<double>& value) {
  return value ? fmt::format("{:g}", *value) : "";
}

std::string band_text(const std::optional<Band>& band) {
  if (!band) return "";
  if (!band->low) return fmt::format("<= {:g}", *band->high);
  if (!band->high) return fmt::format(">= {:g}", *band->low);
  return fmt::format("{:g} to {:g}", *band->low, *band->high);
}

void print_table(const ExperimentResult& result) {
  fmt::print("{}, {} runs, seed {}\n\n", result.name, result.runs, result.seed);
  std::size_t width = 28;
  for (const ExperimentRow& row : result.rows) width = std::max(width, row.name.size());
  fmt::print("{:<{}}  {:<26}{:>9} {:>9}{:>9}   {:<14}{}\n", "condition", width, "metric", "ours",
             "+- sd", "paper", "band", "inside");
  std::string last;
  for (const ExperimentRow& row : result.rows) {
    const char* verdict = !row.band ? "" : *row.inside() ? "yes" : "NO";
    fmt::print("{:<{}}  {:<26}{:>9.3f} {:>9.3f}{:>9}   {:<14}{}\n",
               row.name == last ? "" : row.name, width, row.metric, row.ours, row.spread,
               end_of(row.paper), band_text(row.band), verdict);
    last = row.name;
  }
}

nlohmann::ordered_json number(double value) {
  return std::isnan(value) ? nlohmann::ordered_json() : nlohmann::ordered_json(value);
}

template <class T>
nlohmann::ordered_json maybe(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

void print_json(const ExperimentResult& result) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const ExperimentRow& row : result.rows) {
    nlohmann::ordered_json band;
    if (row.band) band = {maybe(row.band->low), maybe(row.band->high)};
    rows.push_back({{"name", row.name},
                    {"metric", row.metric},
                    {"ours", number(row.ours)},
                    {"spread", number(row.spread)},
                    {"paper", maybe(row.paper)},
                    {"band", band},
                    {"inside", maybe(row.inside())}});
  }
  const nlohmann::ordered_json all{
      {"experiment", result.name}, {"runs", result.runs}, {"seed", result.seed}, {"rows", rows}};
  fmt::print("{}\n", all.dump());
}

/// The folder, made if need be.
std::filesystem::path output_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw UsageError(path + ": cannot be made; name a folder that can be written");
  return path;
}

/// Those of the engine, then those on recorded data.
std::vector<ExperimentEntry> experiments() {
  std::vector<ExperimentEntry> list;
  for (const auto& part : {all_experiments(), recorded_experiments()}) {
    list.insert(list.end(), part.begin(), part.end());
  }
  return list;
}

/// Nothing for a thread of the processor each.
std::optional<Device> device_of(const ExperimentRequest& request, const ExperimentEntry& entry) {
  if (request.device == "auto" || request.device == "tbb") return std::nullopt;
  if (!entry.on_device) {
    throw UsageError(request.name + " runs on auto or tbb only, got --device " + request.device);
  }
  try {
    return Device::named(request.device, request.threads);
  } catch (const std::invalid_argument& e) {
    throw UsageError(e.what());
  }
}

/// Where finished runs are kept; nothing if they are not to be.
std::unique_ptr<RunFile> open_store(const ExperimentRequest& request, const ExperimentEntry& entry,
                                    const std::optional<Device>& device) {
  if (request.keep.empty()) return nullptr;
  const std::string where = device ? request.device : "threads";
  const ExperimentOptions& options = request.options;
  RunOrigin origin{fmt::format("experiment {}", entry.name),
                   std::string("version ") + GLINT_VERSION, "program " + program_digest(),
                   fmt::format("seed {}", options.seed), "device " + where};
  if (!options.data.empty()) origin.push_back("data " + options.data);
  const std::string folder = output_folder(request.keep).string();
  return std::make_unique<RunFile>(
      run_file_name(folder, std::string(entry.name), options.seed, where), origin);
}

/// The figures, written where they are wanted; nothing in a process whose runs another has taken.
std::optional<ExperimentResult> result_of(const ExperimentRequest& request,
                                          const ExperimentEntry& entry, RunTeam* team) {
  const bool leads = team == nullptr || team->leads();
  if (leads && !request.out.empty()) output_folder(request.out);  // refused before any run
  ExperimentOptions options = request.options;
  options.device = device_of(request, entry);
  if (leads) options.progress = team == nullptr ? run_progress() : progress_lines();
  const auto store = leads ? open_store(request, entry, options.device) : nullptr;
  options.store = store.get(), options.team = team;
  Workers workers(request.threads);
  try {
    ExperimentResult result = run_experiment(entry, options, workers);
    return leads ? std::optional(std::move(result)) : std::nullopt;
  } catch (const RunsTakenElsewhere&) {
    return std::nullopt;
  }
}

void report(const ExperimentRequest& request, const ExperimentResult& result) {
  if (request.json) {
    print_json(result);
  } else {
    print_table(result);
  }
  if (request.out.empty()) return;
  const std::filesystem::path folder = output_folder(request.out);
  write_curves((folder / (result.name + ".csv")).string(), result);
  plot_curves((folder / (result.name + ".png")).string(), result);
}

void run(const ExperimentRequest& request) {
  const std::vector<ExperimentEntry> known = experiments();
  const ExperimentEntry& entry = find_experiment(request.name, known);
  const std::unique_ptr<ProcessTeam> team = mpi_team();
  std::optional<ExperimentResult> result;
  try {
    result = result_of(request, entry, team.get());
    if (result) report(request, *result);
  } catch (const std::exception& e) {
    if (team) team->fail(e.what());
    throw;
  }
  if (result && !bands_hold(*result)) throw std::runtime_error("a figure lies outside its band");
}

std::string names() {
  std::string list;
  for (const ExperimentEntry& e : experiments()) {
    list += fmt::format("  {:<20}{} ({} runs)\n", e.name, e.summary, e.runs);
  }
  return list;
}

}  // namespace

void add_experiment(Command& program) {
  Command command = program.subcommand(kExperiment.name, kExperiment.description);
  const auto request = std::make_shared<ExperimentRequest>();
  command.option("name", request->name, "Which one").required();
  command.option("--runs", request->options.runs, "Monte Carlo runs; 0 = the experiment's own")
      .in_range(0, 1000000);
  command.option("--seed", request->options.seed, "Seed of the first run")
      .in_range(0, std::numeric_limits<int>::max())
      .with_default();
  command
      .option("--device", request->device,
              "Where phd-* and hpmht-* run their kernels: auto, serial, tbb, egl or egl:N")
      .with_default();
  command.option("--data", request->options.data, "Folder of recorded data, where one is needed");
  command.option("--out", request->out, "Folder for the curves: CSV and a picture");
  command.option("--keep", request->keep,
                 "Folder that keeps finished runs, which are not repeated");
  command.option("--threads", request->threads, "Threads; 0 = all, the result is the same")
      .in_range(0, 4096);
  command.flag("--json", request->json, "Print JSON instead of a table");
  command.footer("Experiments:\n" + names() +
                 "Exit code 1 if a figure lies outside its band.\n"
                 "Example:\n  glint experiment phd-5.1 --runs 100 --out curves");
  command.callback([request] { run(*request); });
}

}  // namespace glint::cli
