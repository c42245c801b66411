// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/birth_scores/birth_scores.hpp"
#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint_shaders/birth_scores.hpp"

namespace glint {
namespace {
#include "glint/kernels/birth_scores/pass.glsl"
}  // namespace

void BirthScores::egl(const Args& a, gl::Context& context) {
  if (a.map.empty()) return;
  context.run([&](gl::Queue& queue) {
    gl::each_band(queue, a.map.height, a.map.width * sizeof(float), 0, [&](gl::Band band) {
      const FrameView map = gl::rows(a.map, band.first, band.last);
      const ImageView<float> score = gl::rows(a.score, band.first, band.last);
      const gl::Buffer pixels = queue.output(score);
      queue.write(pixels, map);
      const ScorePass pass{map.width * map.height, a.intensity, a.energy, a.intensity_low,
                           a.intensity_high,       a.low,       a.high};
      queue.run(shaders::birth_scores, "scores", static_cast<std::size_t>(pass.count), pass,
                {&pixels});
      queue.read(pixels, score);
    });
  });
}

}  // namespace glint
