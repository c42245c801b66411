// SPDX-License-Identifier: Apache-2.0
// What every shader starts with. A shader is a set of functions without arguments; the host picks
// one as main() (gl::Queue::run) and runs it once an item.
layout(local_size_x = 64) in;

// Number of this invocation's item; the last ones may lie beyond the last item.
uint item() {
  return gl_GlobalInvocationID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) +
         gl_GlobalInvocationID.x;
}
