// SPDX-License-Identifier: Apache-2.0
// C++ and GLSL.
struct ScanPass {
  uint count;
};
const uint kScanBlock = 256u;  // counts that one invocation adds up
