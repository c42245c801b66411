// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/profiles.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "glint/engine/settings.hpp"

namespace glint {
namespace {

using namespace std::string_view_literals;

constexpr std::array kP{"frames.background_frames=45"sv,
                        "frames.background_stride=3"sv,
                        "trackers.mm-phd.snr_low=8"sv,
                        "trackers.mm-phd.snr_high=18"sv,
                        "trackers.mm-phd.birth_particles=4000"sv,
                        "trackers.mm-phd.confirm_hits=5"sv,
                        "trackers.smc-phd.snr_low=8"sv,
                        "trackers.smc-phd.birth_particles=4000"sv,
                        "trackers.smc-phd.confirm_hits=5"sv};
constexpr std::array kL{
    "trackers.mm-phd.snr_low=3.5"sv,           "trackers.mm-phd.birth_particles=8000"sv,
    "trackers.mm-phd.target_particles=4000"sv, "trackers.mm-phd.confirm_hits=3"sv,
    "trackers.smc-phd.snr_low=3.5"sv,          "trackers.smc-phd.birth_particles=8000"sv,
    "trackers.smc-phd.confirm_hits=4"sv};

constexpr std::array kProfiles{
    Profile{"P", "targets that stand out of the noise, before residues of the background", kP},
    Profile{"L", "targets that the noise hides, down to a peak of 1.5 sigma", kL},
};

}  // namespace

std::span<const Profile> all_profiles() { return kProfiles; }

void apply_profile(std::string_view name, std::span<ConfigSection> sections) {
  const auto found = std::ranges::find(kProfiles, name, &Profile::name);
  if (found != kProfiles.end()) {
    for (const std::string_view setting : found->settings) apply_set(setting, sections);
    return;
  }
  std::string known;
  for (const Profile& p : kProfiles) known += (known.empty() ? "" : ", ") + std::string(p.name);
  throw ConfigError("there is no profile '" + std::string(name) + "'; choose one of " + known);
}

}  // namespace glint
