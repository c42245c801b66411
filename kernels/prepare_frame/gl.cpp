// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint/kernels/core/inline.hpp"
#include "glint/kernels/prepare_frame/prepare_frame.hpp"
#include "glint_shaders/prepare_frame_grey.hpp"

namespace glint {
namespace {

#include "glint/kernels/prepare_frame/pass.glsl"

template <class T>
bool convert(gl::Queue& queue, const ToGrey::Args& args, const T* data) {
  const RawPixels& raw = args.raw;
  const ImageView<const T> channels{data, raw.width * raw.channels, raw.height, raw.pitch};
  GreyBand band{0,
                static_cast<uint>(raw.channels),
                sizeof(T),
                args.reciprocal ? 1u : 0u,
                args.reciprocal_floor,
                ToGrey::kLargest};
  const uint none = 0;
  const gl::Buffer masked = queue.upload(std::span(&none, 1));
  const std::size_t of_pixel = std::max(sizeof(T) * band.channels, sizeof(float));
  const std::size_t row = of_pixel * static_cast<std::size_t>(raw.width);
  gl::each_band(queue, raw.height, row, 0, [&](const gl::Band& part) {
    const auto rows = static_cast<uint>(part.last - part.first);
    band.pixels = rows * static_cast<uint>(raw.width);
    const gl::Buffer sent = queue.upload(gl::rows(channels, part.first, part.last)),
                     grey = queue.output(gl::rows(args.grey, part.first, part.last));
    queue.run(shaders::prepare_frame_grey, "to_grey", band.pixels, band, {&sent, &grey, &masked});
    queue.read(grey, gl::rows(args.grey, part.first, part.last));
  });
  uint found = 0;
  queue.read(masked, std::span(&found, 1));
  return found != 0;
}

}  // namespace

void ToGrey::egl(const Args& args, gl::Context& context) {
  bool masked = false;
  if (!args.grey.empty()) {
    context.run([&](gl::Queue& queue) {
      masked =
          std::visit([&](const auto* data) { return convert(queue, args, data); }, args.raw.data);
    });
  }
  if (args.masked != nullptr) *args.masked = masked;
}

}  // namespace glint
