// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/prepare_frame/prepare_frame.hpp"

namespace glint {

std::vector<std::unique_ptr<Trial>> prepare_frame_trials() { return {}; }

}  // namespace glint
