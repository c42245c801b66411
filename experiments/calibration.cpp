// SPDX-License-Identifier: Apache-2.0
#include "glint/experiments/calibration.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "glint/engine/number_text.hpp"
#include "glint/engine/trackers/registry.hpp"
#include "glint/experiments/monte_carlo.hpp"
#include "glint/experiments/scene_run.hpp"

namespace glint {
namespace {

constexpr std::array kThresholds{
    Threshold{"viterbi", "threshold", 0, 100, 200},
    Threshold{"mm-pf", "false_probability", 0.1, 1e-12, 55, true},
    Threshold{"h-pmht", "confirm_count", 0.5, 20.5, 200},
    Threshold{"imm-pda-ai", "start_amplitude", 2, 12, 100},
    Threshold{"mm-phd", "confirm_hits", 1, 25, 24},
    Threshold{"smc-phd", "confirm_hits", 1, 25, 24},
    Threshold{"smc-phd-improved", "confirm_hits", 1, 25, 24},
};

/// Those that were confirmed at any time, online or in hindsight.
std::int64_t confirmed_tracks(const TrackLog& log) {
  std::set<std::int64_t> ids;
  for (const auto& record : {log.online(), log.revised()}) {
    for (const TrackPoint& p : record) {
      if (p.status == TrackStatus::confirmed) ids.insert(p.track_id);
    }
  }
  return static_cast<std::int64_t>(ids.size());
}

/// Runs of one tracker on noise.
class NoiseRuns {
 public:
  NoiseRuns(const Threshold& threshold, ConfigSection& config, const CalibrationOptions& options,
            Workers& workers)
      : threshold_(threshold),
        config_(config),
        field_(*std::ranges::find(config.fields(), threshold.key, &ConfigField::key)),
        options_(options),
        scene_(make_scene(options.noise)),
        workers_(workers) {}

  double megapixel_frames() const {
    return 1e-6 * scene_.width * scene_.height * scene_.frames * options_.runs;
  }
  /// The runs whose seeds start with `seed`; nothing once there are more tracks than `most`.
  std::optional<FalseTracks> at(int step, std::uint64_t seed, double most) {
    assign(field_, threshold_.at(step));
    std::atomic<std::int64_t> tracks = 0;
    const auto run = [&](std::size_t r) {
      if (static_cast<double>(tracks) <= most) tracks += tracks_of(seed + r);
      return true;
    };
    run_jobs(static_cast<std::size_t>(options_.runs), workers_, progress(), run);
    ++probes_;
    if (static_cast<double>(tracks) > most) return std::nullopt;
    const double count = static_cast<double>(tracks), all = megapixel_frames();
    return FalseTracks{tracks, count / all, std::sqrt(std::max(count, 1.0)) / all};
  }

 private:
  std::int64_t tracks_of(std::uint64_t seed) const {
    const Device device = options_.device == DeviceKind::serial ? Device::serial() : Device::tbb(1);
    const auto tracker = find_tracker(threshold_.tracker).make(config_, device, seed);
    PointFinder finder(options_.points, device);
    std::vector<PointMeasurement> points;
    TrackLog log;
    for (int k = 0; k < scene_.frames; ++k) {
      Scan scan = whitened_scan(scene_, seed, k);
      if (tracker->feed() != Feed::frames) finder.find(scan, points), scan.points = points;
      tracker->step(scan, log);
    }
    tracker->finish(log);
    return confirmed_tracks(log);
  }

  std::function<void(int, int)> progress() const {
    if (!options_.progress) return {};
    const int steps = static_cast<int>(std::bit_width(static_cast<unsigned>(threshold_.steps) + 1));
    const int before = probes_ * options_.runs, all = (steps + 1) * options_.runs;
    return [this, before, all](int done, int) { options_.progress(before + done, all); };
  }

  const Threshold& threshold_;
  ConfigSection& config_;
  ConfigField& field_;
  const CalibrationOptions& options_;
  Scene scene_;
  Workers& workers_;
  int probes_ = 0;
};

}  // namespace

double Threshold::at(int step) const {
  const double share = static_cast<double>(step) / steps;
  const double exact =
      geometric ? lax * std::pow(strict / lax, share) : std::lerp(lax, strict, share);
  std::array<char, 32> text;
  const char* const end =
      std::to_chars(text.data(), text.data() + text.size(), exact, std::chars_format::general, 4)
          .ptr;
  double rounded = exact;
  std::from_chars(text.data(), end, rounded);
  return rounded;
}

std::span<const Threshold> all_thresholds() { return kThresholds; }

const Threshold& find_threshold(std::string_view tracker) {
  const TrackerEntry& entry = find_tracker(tracker);
  const auto* const found = std::ranges::find(kThresholds, entry.name, &Threshold::tracker);
  if (found != kThresholds.end()) return *found;
  std::string known;
  for (const Threshold& t : kThresholds) {
    known += (known.empty() ? "" : ", ") + std::string(t.tracker);
  }
  throw ConfigError("tracker " + std::string(tracker) + " has no threshold; choose one of " +
                    known);
}

Calibration calibrate(const Threshold& threshold, ConfigSection& config,
                      const CalibrationOptions& options, Workers& workers) {
  if (options.runs < 1) throw ConfigError("runs must be at least 1");
  NoiseRuns runs(threshold, config, options, workers);
  Calibration result;
  result.megapixel_frames = runs.megapixel_frames();
  const double most = options.false_tracks * result.megapixel_frames;
  int low = 0, high = threshold.steps + 1;  // every step before low is too lax, from high on none
  while (low < high) {
    const int middle = (low + high) / 2;
    if (const auto kept = runs.at(middle, options.seed, most)) {
      high = middle, result.attained = *kept;
    } else {
      low = middle + 1;
    }
  }
  if (low > threshold.steps) {
    throw std::runtime_error("even " + std::string(threshold.key) + " = " +
                             number_text(threshold.at(threshold.steps)) +
                             " gives more false tracks than wanted; allow more");
  }
  result.value = threshold.at(low), result.at_lax_end = low == 0;
  const std::uint64_t others = options.seed + static_cast<std::uint64_t>(options.runs);
  result.checked = *runs.at(low, others, std::numeric_limits<double>::infinity());
  return result;
}

}  // namespace glint
