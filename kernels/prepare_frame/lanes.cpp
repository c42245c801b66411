// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/prepare_frame/lanes.hpp"

#include "glint/kernels/prepare_frame/lanes_grey.hpp"
#include "glint/kernels/prepare_frame/lanes_median.hpp"
#include "glint/kernels/prepare_frame/lanes_registration.hpp"
#include "glint/kernels/prepare_frame/lanes_structure.hpp"
#include "glint/kernels/prepare_frame/lanes_whiten.hpp"

namespace glint::GLINT_LANES {

extern const PrepareFrameLanes prepare_frame_lanes;
const PrepareFrameLanes prepare_frame_lanes{grey_rows<std::uint8_t>,
                                            grey_rows<std::uint16_t>,
                                            grey_rows<float>,
                                            stack_rows<std::uint8_t>,
                                            stack_rows<std::uint16_t>,
                                            stack_rows<float>,
                                            lattice_rows,
                                            structure_tile,
                                            whiten_tile,
                                            make_keys,
                                            count_up_to,
                                            halve_row,
                                            difference_row,
                                            equations_row,
                                            shift_row};

}  // namespace glint::GLINT_LANES
