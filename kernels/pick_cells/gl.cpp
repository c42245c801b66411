// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint/kernels/core/inline.hpp"
#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/pick_cells/pick_cells.hpp"
#include "glint_shaders/pick_cells.hpp"

namespace glint {
namespace {

#include "glint/kernels/pick_cells/pass.glsl"

/// A piece of the cells, over one band of rows after the other.
void pick_piece(gl::Queue& queue, const PickCells::Args& args, std::size_t first,
                std::size_t count) {
  const auto picked = args.picked.subspan(first, count);
  const auto picked_score = args.picked_score.subspan(first, count);
  const auto total = args.total.subspan(first, count);
  const gl::Buffer cells = queue.upload(args.cell.subspan(first, count)),
                   uniforms = queue.upload(args.uniform.subspan(first, count)),
                   drawn = queue.output(picked), scores = queue.output(picked_score),
                   totals = queue.output(total);
  const std::size_t row = sizeof(float) * static_cast<std::size_t>(args.score.width);
  gl::each_band(queue, args.score.height, row, args.reach, [&](const gl::Band& band) {
    const gl::Buffer score = queue.upload(gl::rows(args.score, band.top, band.bottom));
    const PickPass pass{args.score.width, args.score.height,       band.top, band.first, band.last,
                        args.reach,       static_cast<uint>(count)};
    queue.run(shaders::pick_cells, "pick", count, pass,
              {&score, &cells, &uniforms, &drawn, &scores, &totals});
  });
  queue.read(drawn, picked);
  queue.read(scores, picked_score);
  queue.read(totals, total);
}

}  // namespace

void PickCells::egl(const Args& args, gl::Context& context) {
  pick_cells::check(args);
  context.run([&](gl::Queue& queue) {
    const Tiles pieces{args.cell.size(), queue.max_bytes() / sizeof(double)};
    for (std::size_t p = 0; p < pieces.tiles(); ++p) {
      pick_piece(queue, args, pieces.begin(p), pieces.end(p) - pieces.begin(p));
    }
  });
}

}  // namespace glint
