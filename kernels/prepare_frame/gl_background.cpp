// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint/kernels/core/inline.hpp"
#include "glint/kernels/prepare_frame/background.hpp"
#include "glint_shaders/prepare_frame_lattice.hpp"
#include "glint_shaders/prepare_frame_stack.hpp"

namespace glint {
namespace {

#include "glint/kernels/prepare_frame/pass.glsl"

std::size_t pixels_of(const MedianBand& band) {
  return static_cast<std::size_t>(band.width) * static_cast<std::size_t>(band.last - band.first);
}

/// Runs `pass` for the band's pixels and fetches their medians.
void make_medians(gl::Queue& queue, const gl::Shader& shader, std::string_view pass,
                  const MedianBand& band, const gl::Buffer& from, ImageView<float> median) {
  const ImageView<float> made = gl::rows(median, band.first, band.last);
  const gl::Buffer medians = queue.output(made);
  queue.run(shader, pass, pixels_of(band), band, {&from, &medians});
  queue.read(medians, made);
}

template <class T>
void run_stack(gl::Queue& queue, std::span<const ImageView<const T>> images,
               ImageView<float> median) {
  MedianBand band{};
  band.width = median.width, band.height = median.height;
  band.images = static_cast<uint>(images.size()), band.bytes = sizeof(T);
  const std::size_t of_pixel = std::max(sizeof(T) * images.size(), sizeof(float));
  const std::size_t row = of_pixel * static_cast<std::size_t>(median.width);
  gl::each_band(queue, median.height, row, 0, [&](const gl::Band& part) {
    band.top = band.first = part.first, band.last = part.last;
    const std::size_t pixels = pixels_of(band);
    const gl::Buffer sent = queue.buffer<T>(pixels * images.size());
    for (std::size_t i = 0; i < images.size(); ++i) {
      queue.write(sent, gl::rows(images[i], part.first, part.last), i * pixels);
    }
    make_medians(queue, shaders::prepare_frame_stack, "stack_median", band, sent, median);
  });
}

}  // namespace

void StackMedian::egl(const Args& args, gl::Context& context) {
  if (args.median.empty()) return;
  context.run([&](gl::Queue& queue) {
    std::visit([&](const auto& images) { run_stack(queue, images, args.median); }, args.stack);
  });
}

void SpatialMedian::egl(const Args& args, gl::Context& context) {
  if (args.median.empty()) return;
  MedianBand band{};
  band.width = args.image.width, band.height = args.image.height;
  band.spacing = args.spacing;
  const std::size_t row = sizeof(float) * static_cast<std::size_t>(band.width);
  context.run([&](gl::Queue& queue) {
    gl::each_band(queue, band.height, row, 2 * band.spacing, [&](const gl::Band& part) {
      band.top = part.top, band.first = part.first, band.last = part.last;
      const gl::Buffer sent = queue.upload(gl::rows(args.image, part.top, part.bottom));
      make_medians(queue, shaders::prepare_frame_lattice, "spatial_median", band, sent,
                   args.median);
    });
  });
}

}  // namespace glint
