// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/birth_scores/birth_scores.hpp"
#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint_shaders/birth_scores.hpp"

namespace glint {
namespace {

#include "glint/kernels/birth_scores/pass.glsl"
static_assert(sizeof(MaskBox) == sizeof(Box));

void score_band(gl::Queue& queue, const BirthScores::Args& a, const gl::Band& band,
                const gl::Buffer& boxes) {
  const ImageView<float> made = gl::rows(a.score, band.first, band.last);
  const auto rows = static_cast<std::size_t>(made.height);
  const gl::Buffer map = queue.upload(gl::rows(a.map, band.first, band.last)),
                   scores = queue.output(made), sums = queue.buffer<double>(rows);
  const ScorePass pass{
      made.width,  made.height, band.first,      static_cast<uint>(a.masked.size()),
      a.intensity, a.energy,    a.intensity_low, a.intensity_high,
      a.low,       a.high};
  queue.run(shaders::birth_scores, "scores", rows * static_cast<std::size_t>(made.width), pass,
            {&map, &scores, &boxes, &sums});
  queue.read(scores, made);
  if (a.row_sums.empty()) return;
  queue.run(shaders::birth_scores, "sum_rows", rows, pass, {&map, &scores, &boxes, &sums});
  queue.read(sums, a.row_sums.subspan(static_cast<std::size_t>(band.first), rows));
}

}  // namespace

void BirthScores::egl(const Args& a, gl::Context& context) {
  if (a.map.empty()) return;
  context.run([&](gl::Queue& queue) {
    const gl::Buffer boxes = queue.upload(a.masked);
    gl::each_band(queue, a.map.height, static_cast<std::size_t>(a.map.width) * sizeof(float), 0,
                  [&](const gl::Band& band) { score_band(queue, a, band, boxes); });
  });
}

}  // namespace glint
