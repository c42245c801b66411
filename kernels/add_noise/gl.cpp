// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/add_noise/add_noise.hpp"
#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint_shaders/add_noise.hpp"

namespace glint {
namespace {
#include "glint/kernels/add_noise/pass.glsl"
}  // namespace

void AddNoise::egl(const Args& args, gl::Context& context) {
  if (args.image.empty()) return;
  const auto width = static_cast<uint>(args.image.width);
  context.run([&](gl::Queue& queue) {
    gl::each_band(queue, args.image.height, width * sizeof(float), 0, [&](gl::Band band) {
      const ImageView<float> image = gl::rows(args.image, band.first, band.last);
      const gl::Buffer pixels = queue.upload(ImageView<const float>(image));
      const NoisePass pass{words_of(args.key), width * static_cast<uint>(band.first),
                           width * static_cast<uint>(image.height), args.sigma};
      queue.run(shaders::add_noise, "add", pass.count, pass, {&pixels});
      queue.read(pixels, image);
    });
  });
}

}  // namespace glint
