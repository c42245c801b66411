// SPDX-License-Identifier: Apache-2.0
#include <iterator>

#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint/kernels/core/gl_scan.hpp"
#include "glint/kernels/core/inline.hpp"
#include "glint/kernels/pixel_likelihood/check.hpp"
#include "glint_shaders/pixel_likelihood.hpp"

namespace glint {
namespace {

#include "glint/kernels/pixel_likelihood/pass.glsl"
static_assert(std::size(PixelBand{}.relative) == kMaxHalfWidth + 1);
static_assert(sizeof(Hit) == 12);

constexpr const gl::Shader& kShader = shaders::pixel_likelihood;

template <class T>
PixelBand whole_frame(const PixelLikelihood::Args& args, const ImageView<const T>& frame) {
  PixelBand band{};
  band.width = frame.width, band.height = frame.height;
  band.half_width = args.spread.half_width;
  band.uint16 = sizeof(T) == 2 ? 1 : 0;
  const double intensity = args.intensity, centre = args.spread.weight(0, 0);
  for (int k = 0; k <= args.spread.half_width; ++k) {
    const double weight = args.spread.weight(k, 0);
    band.relative[k] = static_cast<float>(weight / centre);
    band.squared[k] = static_cast<float>(weight * weight);
  }
  band.offset = args.offset;
  band.gain = static_cast<float>(intensity * args.scale * centre * centre);
  band.energy_gain = static_cast<float>(-intensity * intensity / 2);
  band.threshold = args.threshold;
  return band;
}

void append_hits(gl::Queue& queue, const PixelBand& band, std::size_t pixels, const gl::Buffer& map,
                 std::vector<Hit>& hits) {
  const std::size_t spans = (pixels + kSpan - 1) / kSpan;
  const gl::Buffer counts = queue.buffer<std::uint32_t>(spans);
  queue.run(kShader, "count_hits", spans, band, {&map, &map, &map, &counts});
  const std::size_t total = gl::sum_before(queue, counts, spans), before = hits.size();
  const gl::Buffer list = queue.buffer<Hit>(total);
  queue.run(kShader, "collect_hits", spans, band, {&map, &map, &map, &counts, &list});
  hits.resize(before + total);
  queue.read(list, std::span(hits).subspan(before));
}

template <class T>
void run_band(gl::Queue& queue, const PixelLikelihood::Args& args, const ImageView<const T>& frame,
              const PixelBand& band, int bottom) {
  const int rows = band.last - band.first;
  const auto pixels = static_cast<std::size_t>(rows) * static_cast<std::size_t>(band.width);
  const gl::Buffer sent = queue.upload(gl::rows(frame, band.top, bottom));
  const ImageView<float> made =
      args.map.empty() ? args.map : gl::rows(args.map, band.first, band.last);
  const gl::Buffer sums = queue.buffer<float>(pixels),
                   map = made.empty() ? queue.buffer<float>(pixels) : queue.output(made);
  queue.run(kShader, "columns", pixels, band, {&sent, &sums});
  queue.run(kShader, "ratios", pixels, band, {&sent, &sums, &map});
  queue.read(map, made);
  if (args.hits != nullptr) append_hits(queue, band, pixels, map, *args.hits);
}

}  // namespace

void PixelLikelihood::egl(const Args& args, gl::Context& context) {
  pixel_likelihood::check(args);
  if (args.hits != nullptr) args.hits->clear();
  std::visit(
      [&](const auto& frame) {
        if (frame.empty()) return;
        context.run([&](gl::Queue& queue) {
          PixelBand band = whole_frame(args, frame);
          // As pixels and as hits.
          const std::size_t row = sizeof(Hit) * static_cast<std::size_t>(frame.width);
          gl::each_band(queue, frame.height, row, band.half_width, [&](gl::Band part) {
            band.top = part.top, band.first = part.first, band.last = part.last;
            run_band(queue, args, frame, band, part.bottom);
          });
        });
      },
      args.frame);
}

}  // namespace glint
