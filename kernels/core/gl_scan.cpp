// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/gl_scan.hpp"

#include <span>

#include "glint/kernels/core/inline.hpp"
#include "glint_shaders/core_scan.hpp"

namespace glint::gl {
namespace {
#include "glint/kernels/core/scan.glsl"
}  // namespace

Buffer scan(Queue& queue, const Buffer& counts, std::size_t count) {
  const ScanPass pass{static_cast<uint>(count)};
  const std::size_t blocks = (count + kScanBlock - 1) / kScanBlock;
  Buffer sums = queue.buffer<uint>(blocks);
  queue.run(shaders::core_scan, "within_blocks", blocks, pass, {&counts, &sums});
  if (blocks <= 1) return sums;
  Buffer all = scan(queue, sums, blocks);
  queue.run(shaders::core_scan, "across_blocks", count, pass, {&counts, &sums});
  return all;
}

std::uint32_t sum_before(Queue& queue, const Buffer& counts, std::size_t count) {
  if (count == 0) return 0;
  const Buffer all = scan(queue, counts, count);
  std::uint32_t sum = 0;
  queue.read(all, std::span(&sum, 1));
  return sum;
}

}  // namespace glint::gl
