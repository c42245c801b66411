// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

#include "glint/engine/profiles.hpp"
#include "glint/engine/settings.hpp"
#include "glint/engine/trackers/registry.hpp"
#include "glint/experiments/monte_carlo.hpp"
#include "glint/frontends/experiments/clip_run.hpp"
#include "glint/frontends/experiments/helicopter.hpp"
#include "glint/frontends/experiments/recorded.hpp"
#include "glint/frontends/files/tables.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint {
namespace {

constexpr std::array kTrackers{"mm-phd", "smc-phd", "h-pmht"};
constexpr int kNoiseRuns = 3, kNoiseFrames = 320;

/// What mm-phd must reach.
struct Wanted {
  std::optional<double> detected{}, gain{}, false_points{}, ospa{}, false_tracks{}, identities{};
};

/// A clip, the noise added to it, and the profile that it is tracked with.
struct Case {
  const char* folder;
  const char* clip;
  double noise;  // [grey levels]
  const char* condition;
  const char* profile;
  bool dark = false;
  Wanted wanted{};

  std::string title(const std::string& tracker) const {
    return std::string(clip) + ' ' + condition + " (" + profile + "), " + tracker;
  }
};

const std::array kCases{
    Case{"ir_birds_multi", "IR_BIRD_027", 0, "as it is", "P", false, {.95, {}, 1, 3.6, 20, 2.5}},
    Case{"ir_birds_multi", "IR_BIRD_027", 53, "at SNR 3", "L", false, {.95, .15, {}, 3.3}},
    Case{"ir_birds_multi", "IR_BIRD_027", 80, "at SNR 2", "L", false, {.93, .4, {}, 3.6}},
    Case{"ir_dim", "IR_BIRD_015", 0, "as it is", "P", false, {.93, {}, {}, 3.0}},
    Case{"ir_dim", "IR_BIRD_015", 4.2, "at SNR 5", "P", false, {.85, .08}},
    Case{"ir_dim", "IR_BIRD_015", 7, "at SNR 3", "L", false, {.9, .3}},
    Case{"visible_sky", "V_BIRD_009", 3, "at SNR 5", "P", true, {.7}},
    Case{"visible_sky", "V_BIRD_009", 5, "at SNR 3", "P", true, {.45, .05}},
    Case{"ir_dim", "IR_AIRPLANE_026", 0, "as it is", "P", false, {.95, {}, .3}},
};

/// Settings of frames and trackers under a profile. A recorded clip's background may be learned
/// ahead of its first frame.
std::vector<ConfigSection> sections_of(const char* profile, bool dark) {
  std::vector<ConfigSection> sections{ConfigSection::of<FramesConfig>("frames")};
  for (const char* name : kTrackers) sections.push_back(find_tracker(name).config());
  apply_profile(profile, sections);
  apply_set("frames.background_prime=90", sections);
  if (dark) apply_set("frames.polarity=dark", sections);
  return sections;
}

std::vector<ClipTracker> trackers_of(const std::vector<ConfigSection>& sections) {
  std::vector<ClipTracker> trackers;
  for (std::size_t i = 0; i < kTrackers.size(); ++i) {
    trackers.push_back({kTrackers[i], sections[i + 1]});
  }
  return trackers;
}

ClipInput read_clip(const std::string& data, const std::string& folder, const std::string& name) {
  const std::filesystem::path at = std::filesystem::path(data) / folder;
  const std::string frames = (at / (name + ".mp4")).string();
  const std::string truth = (at / "derived" / (name + "_truth.csv")).string();
  for (const std::string& file : {frames, truth}) {
    if (std::filesystem::exists(file)) continue;
    throw UsageError(file +
                     ": is not there; give --data the folder that docs/real-video.md describes");
  }
  return {frames, read_truth(truth)};
}

/// A figure of one run; `low` tells which end of the band is closed.
struct Figure {
  const char* metric;
  std::function<double(const ClipScore&)> of;
  std::optional<double> Wanted::*wanted;
  bool low;
};

double gain(const ClipScore& s) { return s.online.detected_points - s.baseline.detected_points; }

const std::array kFigures{
    Figure{"detected", [](const ClipScore& s) { return s.online.detected_points; },
           &Wanted::detected, true},
    Figure{"above matched filter", gain, &Wanted::gain, true},
    Figure{"false points a frame",
           [](const ClipScore& s) { return s.online.false_points_per_frame; },
           &Wanted::false_points, false},
    Figure{"OSPA [px]", [](const ClipScore& s) { return s.online.mean_ospa.distance; },
           &Wanted::ospa, false},
    Figure{"false tracks", [](const ClipScore& s) { return double(s.online.false_tracks); },
           &Wanted::false_tracks, false},
    Figure{"identities a truth", [](const ClipScore& s) { return s.online.identities_per_truth; },
           &Wanted::identities, false},
    Figure{"detected, revised", [](const ClipScore& s) { return s.revised.detected_points; },
           nullptr, true},
    Figure{"OSPA, revised [px]", [](const ClipScore& s) { return s.revised.mean_ospa.distance; },
           nullptr, false},
};

/// `runs`: the scores of every run, one a tracker.
void add_rows(const Case& c, const std::vector<std::vector<ClipScore>>& runs,
              ExperimentResult& result) {
  for (std::size_t t = 0; t < kTrackers.size(); ++t) {
    for (const Figure& figure : kFigures) {
      std::vector<double> values;
      values.reserve(runs.size());
      for (const auto& scores : runs) values.push_back(figure.of(scores[t]));
      ExperimentRow row = value_row(c.title(kTrackers[t]), figure.metric, values);
      if (t == 0 && figure.wanted != nullptr && c.wanted.*figure.wanted) {
        const std::optional<double> end = c.wanted.*figure.wanted;
        row.band = figure.low ? Band{end, {}} : Band{{}, end};
      }
      result.rows.push_back(std::move(row));
    }
  }
}

/// At most one track in all runs together.
void add_noise_rows(const char* profile, std::uint64_t seed, Workers& workers,
                    ExperimentResult& result) {
  const std::vector<ConfigSection> sections = sections_of(profile, false);
  const auto runs = run_jobs(kNoiseRuns, workers, {}, [&](std::size_t run) {
    return tracks_in_noise({320, 256, kNoiseFrames}, sections.front().as<FramesConfig>(),
                           trackers_of(sections), seed + run);
  });
  for (std::size_t t = 0; t < kTrackers.size(); ++t) {
    double tracks = 0;
    for (const auto& run : runs) tracks += run[t];
    ExperimentRow row = value_row(std::string("white noise (") + profile + "), " + kTrackers[t],
                                  "tracks in 3 x 320 frames", {tracks});
    if (t == 0) row.band = Band{{}, 1};
    result.rows.push_back(std::move(row));
  }
}

void add_aircraft_rows(const ClipInput& clip, CellIntensity intensity, double most,
                       ExperimentResult& result) {
  const AircraftClip score = follow_aircraft(clip.frames, clip.truth, intensity);
  const std::string name = std::string("V_HELICOPTER_013, h-pmht, ") +
                           (intensity == CellIntensity::rpim ? "rpim" : "rpim-normalised");
  ExperimentRow hit = value_row(name, "hit on target [%]", {score.hit});
  ExperimentRow deviation = value_row(name, "deviation [px]", {score.deviation});
  hit.band = Band{100, {}}, deviation.band = Band{{}, most};
  result.rows.insert(result.rows.end(), {std::move(hit), std::move(deviation)});
}

}  // namespace

ExperimentResult run_real_video(const ExperimentOptions& options, Workers& workers) {
  if (options.data.empty()) {
    throw UsageError("real-video needs --data FOLDER; docs/real-video.md says what it must hold");
  }
  const ClipInput aircraft = read_clip(options.data, "visible_sky", "V_HELICOPTER_013");
  std::vector<ClipInput> clips;
  std::vector<std::vector<ConfigSection>> sections;
  for (const Case& c : kCases) {
    clips.push_back(read_clip(options.data, c.folder, c.clip));
    clips.back().noise = c.noise;
    sections.push_back(sections_of(c.profile, c.dark));
  }
  const auto runs = run_cases(kCases.size(), options, workers, [&](std::size_t i, std::size_t run) {
    return run_clip(clips[i], sections[i].front().as<FramesConfig>(), trackers_of(sections[i]),
                    options.seed + run);
  });
  ExperimentResult result;
  for (std::size_t i = 0; i < kCases.size(); ++i) add_rows(kCases[i], runs[i], result);
  for (const char* profile : {"P", "L"}) add_noise_rows(profile, options.seed, workers, result);
  add_aircraft_rows(aircraft, CellIntensity::rpim, 4, result);
  add_aircraft_rows(aircraft, CellIntensity::rpim_normalised, 3, result);
  return result;
}

}  // namespace glint
