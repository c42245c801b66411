// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/imm_window.hpp"

#include "glint/engine/state/fields.hpp"

namespace glint {

template class ImmMultiscanJpda<PositionSensor<2>>;
template class ImmMultiscanJpda<RangeAzimuth>;
template class ImmWindow<PositionSensor<2>>;
template class ImmWindow<RangeAzimuth>;

}  // namespace glint
