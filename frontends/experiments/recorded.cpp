// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/experiments/recorded.hpp"

#include <array>

namespace glint {
namespace {

constexpr std::array kExperiments{
    ExperimentEntry{"real-video", "dim birds and aircraft in real clips; needs --data", 5,
                    run_real_video},
};

}  // namespace

std::span<const ExperimentEntry> recorded_experiments() { return kExperiments; }

}  // namespace glint
