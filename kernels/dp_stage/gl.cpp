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

/// dx in the low byte, dy in the next.
std::vector<uint> packed(const MovesView& moves, int top, int bottom) {
  std::vector<uint> words;
  for (int y = top; y < bottom && !moves.empty(); ++y) {
    for (int x = 0; x < moves.dx.width; ++x) {
      words.push_back(static_cast<std::uint8_t>(moves.dx(x, y)) |
                      static_cast<uint>(static_cast<std::uint8_t>(moves.dy(x, y))) << 8);
    }
  }
  return words;
}

void unpack(const std::vector<uint>& words, const DpStage::Args& args, int first, int last) {
  auto word = words.begin();
  for (int y = first; y < last; ++y) {
    for (int x = 0; x < args.dx.width; ++x, ++word) {
      args.dx(x, y) = static_cast<std::int8_t>(*word & 0xff);
      args.dy(x, y) = static_cast<std::int8_t>(*word >> 8 & 0xff);
    }
  }
}

void run_band(gl::Queue& queue, const DpStage::Args& args, const gl::Band& part) {
  const StageBand band{
      args.score.width, args.score.height, part.top,       part.first,
      part.last,        args.reach,        args.tolerance, args.moves.empty() ? 0u : 1u};
  const auto cells =
      static_cast<std::size_t>(band.width) * static_cast<std::size_t>(band.last - band.first);
  std::vector<uint> moves = packed(args.moves, part.top, part.bottom);
  const gl::Buffer score = queue.upload(gl::rows(args.score, part.first, part.last)),
                   before = queue.upload(gl::rows(args.before, part.top, part.bottom)),
                   sent = queue.upload(std::span<const uint>(moves)),
                   total = queue.buffer<float>(cells), best = queue.buffer<uint>(cells);
  queue.run(shaders::dp_stage, "stage", cells, band, {&score, &before, &sent, &total, &best});
  queue.read(total, gl::rows(args.total, part.first, part.last));
  moves.resize(cells);
  queue.read(best, std::span(moves));
  unpack(moves, args, part.first, part.last);
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
