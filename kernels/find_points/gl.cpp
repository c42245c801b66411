// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint/kernels/core/gl_scan.hpp"
#include "glint/kernels/core/inline.hpp"
#include "glint/kernels/find_points/find_points.hpp"
#include "glint_shaders/find_points.hpp"

namespace glint {
namespace {

#include "glint/kernels/find_points/pass.glsl"
constexpr const gl::Shader& kShader = shaders::find_points;
static_assert(sizeof(Point) == 12);

/// Pixels or units of a band.
std::size_t items_of(const PointBand& band) {
  const auto units = [&](int pixels) {
    return static_cast<std::size_t>(band.units != 0 ? (pixels + kUnit - 1) / kUnit : pixels);
  };
  return units(band.width) * units(band.last - band.first);
}

void append_points(gl::Queue& queue, const FindPoints::Args& args, const PointBand& band,
                   int bottom) {
  const gl::Buffer map = queue.upload(gl::rows(args.map, band.top, bottom));
  const std::size_t spans = (items_of(band) + kSpan - 1) / kSpan;
  const gl::Buffer counts = queue.buffer<uint>(spans);
  queue.run(kShader, "count_points", spans, band, {&map, &counts});
  const std::size_t total = gl::sum_before(queue, counts, spans), before = args.points->size();
  const gl::Buffer list = queue.buffer<Point>(total);
  queue.run(kShader, "collect_points", spans, band, {&map, &counts, &list});
  args.points->resize(before + total);
  queue.read(list, std::span(*args.points).subspan(before));
}

}  // namespace

void FindPoints::egl(const Args& args, gl::Context& context) {
  args.points->clear();
  if (args.map.empty()) return;
  const bool units = args.mode == Mode::unit_5x5;
  const int height = args.map.height;
  // Bands are of whole groups of rows, so that no unit is cut. A row of maxima may be all points.
  const int group = units ? kUnit : 1, margin = units ? 0 : std::max(1, args.radius);
  const std::size_t row = sizeof(Point) * static_cast<std::size_t>(args.map.width);
  PointBand band{args.map.width, height, 0, 0, 0, args.radius, units ? 1u : 0u, args.threshold};
  context.run([&](gl::Queue& queue) {
    const int groups = (height + group - 1) / group;
    gl::each_band(queue, groups, row * static_cast<std::size_t>(group), margin, [&](gl::Band part) {
      band.top = part.top * group, band.first = part.first * group;
      band.last = std::min(height, part.last * group);
      append_points(queue, args, band, std::min(height, part.bottom * group));
    });
  });
}

}  // namespace glint
