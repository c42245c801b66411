// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/experiments/recorded.hpp"

#include <array>

namespace glint {
namespace {

constexpr std::array kExperiments{
    ExperimentEntry{"real-video", "dim birds and aircraft in real clips; needs --data", 5,
                    run_real_video},
    ExperimentEntry{"jpda-boats", "two boats seen by radar and lidar; needs --data", 1,
                    run_jpda_boats},
    ExperimentEntry{"jpda-boats-stress", "the same, thinned and among clutter; needs --data", 150,
                    run_jpda_boats_stress},
};

}  // namespace

std::span<const ExperimentEntry> recorded_experiments() { return kExperiments; }

}  // namespace glint
