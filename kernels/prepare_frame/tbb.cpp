// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/prepare_frame/prepare_frame.hpp"

namespace glint {

void ToGrey::tbb(const Args& args, Workers&) { serial(args); }
void StackMedian::tbb(const Args& args, Workers&) { serial(args); }
void SpatialMedian::tbb(const Args& args, Workers&) { serial(args); }
void BackgroundStructure::tbb(const Args& args, Workers&) { serial(args); }
void RobustSpread::tbb(const Args& args, Workers&) { serial(args); }
void Whiten::tbb(const Args& args, Workers&) { serial(args); }
void Halve::tbb(const Args& args, Workers&) { serial(args); }
void EstimateShift::tbb(const Args& args, Workers&) { serial(args); }
void ShiftImage::tbb(const Args& args, Workers&) { serial(args); }

}  // namespace glint
