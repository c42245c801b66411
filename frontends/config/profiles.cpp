// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/config/profiles.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "glint/frontends/config/toml.hpp"

namespace glint {
namespace {

constexpr std::array kProfiles{
    Profile{"P", "targets that stand out of the noise, before residues of the background", R"(
[frames]
background_frames = 45
background_stride = 3

[trackers.mm-phd]
snr_low = 8.0
snr_high = 18.0
birth_particles = 4000
confirm_hits = 5

[trackers.smc-phd]
snr_low = 8.0
birth_particles = 4000
confirm_hits = 5
)"},
    Profile{"L", "targets that the noise hides, down to a peak of 1.5 sigma", R"(
[trackers.mm-phd]
snr_low = 3.5
birth_particles = 8000
target_particles = 4000

[trackers.smc-phd]
snr_low = 3.5
birth_particles = 8000
confirm_hits = 4
)"},
};

}  // namespace

std::span<const Profile> all_profiles() { return kProfiles; }

void apply_profile(std::string_view name, std::span<ConfigSection> sections) {
  const auto found = std::ranges::find(kProfiles, name, &Profile::name);
  if (found != kProfiles.end()) {
    return parse_toml(found->toml, "profile " + std::string(name), sections);
  }
  std::string known;
  for (const Profile& p : kProfiles) known += (known.empty() ? "" : ", ") + std::string(p.name);
  throw ConfigError("there is no profile '" + std::string(name) + "'; choose one of " + known);
}

}  // namespace glint
