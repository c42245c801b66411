// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/particle_likelihood/check.hpp"
#include "glint/kernels/particle_likelihood/polynomials.hpp"
#include "glint_shaders/particle_likelihood.hpp"

namespace glint {
namespace {

#include "glint/kernels/particle_likelihood/pass.glsl"
static_assert(sizeof(ParticleBand{}.even) == sizeof(WeightPolynomials{}.even));

ParticleBand whole_frame(const ParticleLikelihood::Args& args) {
  const WeightPolynomials weights = fit_weights(args.spread);
  ParticleBand band{};
  band.key = words_of(args.key);
  band.width = args.frame.width, band.height = args.frame.height;
  band.half_width = args.spread.half_width;
  band.jitter = args.jitter;
  band.terms = weights.terms, band.scale = weights.scale;
  for (int k = 0; k <= kMaxHalfWidth; ++k) {
    std::copy_n(weights.even[k], kMaxTerms, band.even + k * kMaxTerms);
    std::copy_n(weights.odd[k], kMaxTerms, band.odd + k * kMaxTerms);
  }
  return band;
}

/// A piece of the particles, over one band of rows after the other.
void run_piece(gl::Queue& queue, const ParticleLikelihood::Args& args, ParticleBand band) {
  const auto sent = [&](std::span<const float> values) {
    return queue.upload(values.subspan(band.first, band.count));
  };
  const gl::Buffer x = sent(args.x), y = sent(args.y), intensity = sent(args.intensity);
  const std::span<float> made = args.log_ratio.subspan(band.first, band.count);
  const gl::Buffer log_ratio = queue.output(made);
  const std::size_t row = sizeof(float) * static_cast<std::size_t>(band.width);
  gl::each_band(queue, band.height, row, band.half_width, [&](gl::Band part) {
    band.top = part.top, band.row_first = part.first, band.row_last = part.last;
    const gl::Buffer frame = queue.upload(gl::rows(args.frame, part.top, part.bottom));
    queue.run(shaders::particle_likelihood, "ratios", band.count, band,
              {&frame, &x, &y, &intensity, &log_ratio});
  });
  queue.read(log_ratio, made);
}

}  // namespace

void ParticleLikelihood::egl(const Args& args, gl::Context& context) {
  particle_likelihood::check(args);
  if (args.frame.empty()) {
    std::fill(args.log_ratio.begin(), args.log_ratio.end(),
              -std::numeric_limits<float>::infinity());
    return;
  }
  ParticleBand band = whole_frame(args);
  context.run([&](gl::Queue& queue) {
    const Tiles pieces{args.x.size(), queue.max_bytes() / sizeof(float)};
    for (std::size_t p = 0; p < pieces.tiles(); ++p) {
      band.first = static_cast<uint>(pieces.begin(p));
      band.count = static_cast<uint>(pieces.end(p) - pieces.begin(p));
      run_piece(queue, args, band);
    }
  });
}

}  // namespace glint
