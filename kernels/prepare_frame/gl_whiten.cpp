// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint/kernels/core/inline.hpp"
#include "glint/kernels/prepare_frame/lanes.hpp"
#include "glint/kernels/prepare_frame/whiten.hpp"
#include "glint_shaders/prepare_frame_residuals.hpp"
#include "glint_shaders/prepare_frame_spread.hpp"
#include "glint_shaders/prepare_frame_structure.hpp"
#include "glint_shaders/prepare_frame_whiten.hpp"

namespace glint {
namespace {

#include "glint/kernels/prepare_frame/pass.glsl"

std::size_t pixels_of(int width, int first, int last) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(last - first);
}

void structure_band(gl::Queue& queue, const BackgroundStructure::Args& args, StructureBand band,
                    const gl::Band& part) {
  constexpr int kDilation = 2;
  const gl::Buffer sent = queue.upload(gl::rows(args.background, part.top, part.bottom));
  band.top = part.top;
  band.first = std::max(0, part.first - kDilation);
  band.last = std::min(band.height, part.last + kDilation);
  const std::size_t gradients = pixels_of(band.width, band.first, band.last);
  const gl::Buffer gradient = queue.buffer<float>(gradients);
  queue.run(shaders::prepare_frame_structure, "gradient", gradients, band, {&sent, &gradient});
  band.top = band.first, band.first = part.first, band.last = part.last;
  const std::size_t pixels = pixels_of(band.width, band.first, band.last);
  const ImageView<float> made = gl::rows(args.structure, part.first, part.last);
  const gl::Buffer structure = queue.output(made);
  queue.run(shaders::prepare_frame_structure, "dilate", pixels, band, {&gradient, &structure});
  queue.read(structure, made);
}

WhitenBand whole_frame(const Whiten::Args& args) {
  const WhitenPass pass = whiten_pass(args);
  WhitenBand band{};
  band.width = pass.width, band.height = pass.height;
  band.outer = pass.outer, band.inner = pass.inner;
  band.sigma = pass.sigma, band.inverse_sigma = pass.inverse_sigma;
  band.energy_scale = pass.energy_scale, band.energy_cap = pass.energy_cap;
  band.keep_bits = pass.keep_bits, band.flip_bits = pass.flip_bits;
  band.offset = pass.offset;
  band.clip_low = pass.clip_low, band.clip_high = pass.clip_high;
  band.structured = args.structure.empty() ? 0 : 1;
  band.noise_step = args.noise.empty() ? 0 : args.noise_step;
  return band;
}

/// The rows of the noise map that a band makes.
ImageView<float> noise_rows(const Whiten::Args& args, const WhitenBand& band) {
  if (band.noise_step == 0) return {};
  const auto row = [&](int y) { return (y + band.noise_step - 1) / band.noise_step; };
  return gl::rows(args.noise, row(band.first), row(band.last));
}

void whiten_band(gl::Queue& queue, const Whiten::Args& args, WhitenBand band,
                 const gl::Band& part) {
  band.top = part.top, band.bottom = part.bottom;
  band.first = part.first, band.last = part.last;
  const std::size_t sent = pixels_of(band.width, band.top, band.bottom);
  const ImageView<float> made = gl::rows(args.whitened, band.first, band.last);
  const ImageView<float> noise = noise_rows(args, band);
  const FrameView structure = band.structured != 0 ? args.structure : FrameView{};
  const gl::Buffer image = queue.upload(gl::rows(args.image, band.top, band.bottom)),
                   background = queue.upload(gl::rows(args.background, band.top, band.bottom)),
                   least = queue.upload(
                       structure.empty() ? structure : gl::rows(structure, band.first, band.last)),
                   energies = queue.buffer<uint>(sent), rings = queue.buffer<Ring>(sent),
                   whitened = queue.output(made),
                   noises = queue.buffer<float>(pixels_of(noise.width, 0, noise.height));
  const auto run = [&](std::string_view pass, std::size_t items) {
    queue.run(shaders::prepare_frame_whiten, pass, items, band,
              {&image, &background, &least, &energies, &rings, &whitened, &noises});
  };
  if (band.outer > 0) {
    run("energy", sent);
    run("along", sent);
  }
  run("whiten", pixels_of(band.width, band.first, band.last));
  queue.read(whitened, made);
  queue.read(noises, noise);
}

/// Residuals on the grid, row by row.
void gather_residuals(gl::Queue& queue, const RobustSpread::Args& args,
                      std::vector<float>& residuals) {
  const int width = args.image.width, step = RobustSpread::step(width, args.image.height);
  const std::size_t row = sizeof(float) * static_cast<std::size_t>(width);
  ResidualBand band{};
  band.width = static_cast<uint>(width), band.step = static_cast<uint>(step);
  band.columns = static_cast<uint>((width + step - 1) / step);
  band.less = args.background.empty() ? 0 : 1;
  gl::each_band(queue, args.image.height, row, 0, [&](const gl::Band& part) {
    const int first = (part.first + step - 1) / step * step;
    band.first = static_cast<uint>(first - part.first);
    band.rows = static_cast<uint>(std::max(0, part.last - first + step - 1) / step);
    const std::size_t before = residuals.size(), made = std::size_t{band.columns} * band.rows;
    const FrameView less =
        band.less != 0 ? gl::rows(args.background, part.first, part.last) : FrameView{};
    const gl::Buffer image = queue.upload(gl::rows(args.image, part.first, part.last)),
                     background = queue.upload(less), gathered = queue.buffer<float>(made);
    queue.run(shaders::prepare_frame_residuals, "gather", made, band,
              {&image, &background, &gathered});
    residuals.resize(before + made);
    queue.read(gathered, std::span(residuals).subspan(before));
  });
}

}  // namespace

void BackgroundStructure::egl(const Args& args, gl::Context& context) {
  if (args.background.empty()) return;
  constexpr int kReach = 3;  // 3x3, then 5x5
  const StructureBand band{args.background.width, args.background.height, 0, 0, 0, args.share};
  const std::size_t row = sizeof(float) * static_cast<std::size_t>(band.width);
  context.run([&](gl::Queue& queue) {
    gl::each_band(queue, band.height, row, kReach,
                  [&](const gl::Band& part) { structure_band(queue, args, band, part); });
  });
}

void RobustSpread::egl(const Args& args, gl::Context& context) {
  std::vector<float> own;
  std::vector<float>& residuals = args.workspace == nullptr ? own : *args.workspace;
  residuals.clear();
  *args.spread = {};
  if (args.image.empty()) return;
  std::array<float, 2> found{};
  context.run([&](gl::Queue& queue) {
    gather_residuals(queue, args, residuals);
    std::erase_if(residuals, [](float r) { return std::isnan(r); });
    if (residuals.empty()) return;
    const gl::Buffer sent = queue.upload(std::span(residuals)),
                     spread = queue.buffer<float>(found.size());
    const SpreadPass pass{static_cast<int>(residuals.size())};
    queue.run(shaders::prepare_frame_spread, "robust_spread", 1, pass, {&sent, &spread});
    queue.read(spread, std::span<float>(found));
  });
  args.spread->median = static_cast<double>(found[0]);
  args.spread->sigma = 1.4826 * static_cast<double>(found[1]);
}

void Whiten::egl(const Args& args, gl::Context& context) {
  if (args.image.empty()) return;
  const WhitenBand band = whole_frame(args);
  const std::size_t row = sizeof(Ring) * static_cast<std::size_t>(band.width);
  context.run([&](gl::Queue& queue) {
    gl::each_band(queue, band.height, row, band.outer,
                  [&](const gl::Band& part) { whiten_band(queue, args, band, part); });
  });
}

}  // namespace glint
