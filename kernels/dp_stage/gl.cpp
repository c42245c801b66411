// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint/kernels/core/inline.hpp"
#include "glint/kernels/dp_stage/dp_stage.hpp"
#include "glint_shaders/dp_stage.hpp"

namespace glint {
namespace {

#include "glint/kernels/dp_stage/pass.glsl"

/// Bands go from top to bottom: a band's last word of moves may spoil the first bytes of the next.
void run_band(gl::Queue& queue, const DpStage::Args& args, const gl::Band& part) {
  const StageBand band{
      args.score.width, args.score.height, part.top,       part.first,
      part.last,        args.reach,        args.tolerance, args.moves.empty() ? 0u : 1u};
  const auto cells =
      static_cast<std::size_t>(band.width) * static_cast<std::size_t>(band.last - band.first);
  const auto moves = [&](const ImageView<const std::int8_t>& all) {
    return queue.upload(all.empty() ? all : gl::rows(all, part.top, part.bottom));
  };
  const ImageView<float> made = gl::rows(args.total, part.first, part.last);
  const ImageView<std::int8_t> dx = gl::rows(args.dx, part.first, part.last),
                               dy = gl::rows(args.dy, part.first, part.last);
  const gl::Buffer score = queue.upload(gl::rows(args.score, part.first, part.last)),
                   before = queue.upload(gl::rows(args.before, part.top, part.bottom)),
                   moves_x = moves(args.moves.dx), moves_y = moves(args.moves.dy),
                   total = queue.output(made), best = queue.buffer<uint>(cells),
                   best_x = queue.output(dx), best_y = queue.output(dy);
  const auto run = [&](std::string_view pass, std::size_t items) {
    queue.run(shaders::dp_stage, pass, items, band,
              {&score, &before, &moves_x, &moves_y, &total, &best, &best_x, &best_y});
  };
  run("stage", cells);
  run("split", (cells + 3) / 4);
  queue.read(total, made);
  queue.read(best_x, dx);
  queue.read(best_y, dy);
}

}  // namespace

void DpStage::egl(const Args& args, gl::Context& context) {
  dp_stage::check(args);
  if (args.score.empty()) return;
  const std::size_t row = sizeof(float) * static_cast<std::size_t>(args.score.width);
  context.run([&](gl::Queue& queue) {
    gl::each_band(queue, args.score.height, row, args.reach,
                  [&](gl::Band band) { run_band(queue, args, band); });
  });
}

}  // namespace glint
