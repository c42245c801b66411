// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/registry.hpp"

#include <algorithm>
#include <array>

#include "glint/engine/trackers/h_pmht/h_pmht.hpp"
#include "glint/engine/trackers/imm_pda_ai/imm_pda_ai.hpp"
#include "glint/engine/trackers/jpda/imm_jpda.hpp"
#include "glint/engine/trackers/phd/mm_pf.hpp"
#include "glint/engine/trackers/phd/mm_phd.hpp"
#include "glint/engine/trackers/phd/smc_phd.hpp"
#include "glint/engine/trackers/pmht/mmpf_pmht.hpp"
#include "glint/engine/trackers/pmht/pmht.hpp"
#include "glint/engine/trackers/viterbi/viterbi.hpp"

namespace glint {
namespace {

template <class T, class Config>
constexpr TrackerEntry entry(std::string_view name, std::string_view summary,
                             Feed feed = Feed::frames) {
  return {name, summary, feed,
          [](std::string section) { return ConfigSection::of<Config>(std::move(section)); },
          [](const ConfigSection& config, const Device& device,
             std::uint64_t seed) -> std::unique_ptr<Tracker> {
            return std::make_unique<T>(config.as<Config>(), device, seed);
          }};
}

constexpr std::array kTrackers{
    entry<SmcPhd, SmcPhdConfig>("smc-phd",
                                "particle PHD filter on raw frames, with persistent identities"),
    entry<MmPhd, MmPhdConfig>("mm-phd", "PHD detector, a particle filter a target, backward pass"),
    entry<MmPf, MmPfConfig>(
        "mm-pf", "particle filter a target, declared by a likelihood ratio test on a search cloud"),
    entry<SmcPhd, SmcPhdImprovedConfig>(
        "smc-phd-improved", "smc-phd with adaptive process noise and resampling on likelihood"),
    entry<HPmht, HPmhtConfig>(
        "h-pmht", "histogram PMHT: expectation maximisation over all pixels of a few frames"),
    entry<ImmPdaAi, ImmPdaAiConfig>(
        "imm-pda-ai", "points by multiple models and probabilistic association, with amplitudes",
        Feed::both),
    entry<ImmJpda, ImmJpdaConfig>(
        "imm-jpda", "points by multiple models and joint probabilistic association", Feed::points),
    entry<ImmJpda, ImmMscanJpdaConfig>("imm-mscan-jpda", "imm-jpda over a window of scans",
                                       Feed::points),
    entry<MmpfPmht, MmpfPmhtConfig>(
        "mmpf-pmht", "points by PMHT over all targets, a particle filter a motion model",
        Feed::points),
    entry<Pmht, PmhtConfig>(
        "pmht-imm", "points by PMHT over all targets, models mixed: constant acceleration, Singer",
        Feed::points),
    entry<Pmht, PmhtCaConfig>("pmht-ca", "pmht-imm with constant acceleration alone", Feed::points),
    entry<Pmht, PmhtSingerConfig>("pmht-singer", "pmht-imm with Singer's model alone",
                                  Feed::points),
    entry<Pmht, PmhtHomotheticConfig>(
        "pmht-homothetic", "pmht-imm with one model at two levels of process noise", Feed::points),
    entry<Viterbi, ViterbiConfig>(
        "viterbi", "dynamic programming: the best paths through a sliding window of frames"),
};

}  // namespace

std::span<const TrackerEntry> all_trackers() { return kTrackers; }

const TrackerEntry& find_tracker(std::string_view name) {
  const auto* const found = std::ranges::find(kTrackers, name, &TrackerEntry::name);
  if (found != kTrackers.end()) return *found;
  std::string message = "tracker '" + std::string(name) + "' is not known: use ";
  for (const TrackerEntry& tracker : kTrackers) {
    if (&tracker != kTrackers.data()) message += ", ";
    message += tracker.name;
  }
  throw ConfigError(message);
}

}  // namespace glint
