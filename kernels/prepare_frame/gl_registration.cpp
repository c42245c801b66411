// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint/kernels/core/inline.hpp"
#include "glint/kernels/prepare_frame/registration.hpp"
#include "glint/kernels/prepare_frame/search.hpp"
#include "glint_shaders/prepare_frame_halve.hpp"
#include "glint_shaders/prepare_frame_moved.hpp"

namespace glint {
namespace {

#include "glint/kernels/prepare_frame/pass.glsl"
constexpr const gl::Shader& kMoved = shaders::prepare_frame_moved;

MovedBand moved_by(FrameView frame, double dx, double dy) {
  MovedBand band{};
  band.width = frame.width, band.height = frame.height, band.step = 1;
  const double ix = std::floor(dx), iy = std::floor(dy);
  band.ix = static_cast<int>(ix), band.iy = static_cast<int>(iy);
  band.ax = static_cast<float>(dx - ix), band.ay = static_cast<float>(dy - iy);
  return band;
}

/// A pair of frames on the device, in bands of the reference's rows with all rows of the moving
/// frame that a search may hold against them.
class DevicePair {
 public:
  DevicePair(gl::Queue& queue, FrameView reference, FrameView moving, int farthest)
      : queue_(queue), reference_(reference) {
    const std::size_t row = sizeof(float) * static_cast<std::size_t>(reference.width);
    gl::each_band(queue, reference.height, row, farthest, [&](const gl::Band& part) {
      bands_.push_back({part, queue.upload(gl::rows(reference, part.top, part.bottom)),
                        queue.upload(gl::rows(moving, part.top, part.bottom))});
    });
  }

  bool shows(FrameView reference) const { return reference.data == reference_.data; }

  double difference(double dx, double dy) const {
    double sum = 0;
    std::int64_t count = 0;
    each_sum<DifferenceSum>("sum_differences", 0, dx, dy,
                            [&](const DifferenceSum& s) { sum += s.sum, count += s.count; });
    return count == 0 ? 0 : sum / static_cast<double>(count);
  }

  NormalEquations equations(double dx, double dy) const {
    NormalEquations n;
    each_sum<EquationSum>("sum_equations", 1, dx, dy, [&](const EquationSum& s) {
      n.xx += s.xx, n.xy += s.xy, n.yy += s.yy, n.xe += s.xe, n.ye += s.ye;
    });
    return n;
  }

 private:
  struct RowBand {
    gl::Band rows;
    gl::Buffer reference, moving;
  };

  /// Calls add(sum) for the spans of every row that the estimate looks at, `border` rows from the
  /// frame's edges, in order.
  template <class Sum, class Add>
  void each_sum(std::string_view pass, int border, double dx, double dy, const Add& add) const {
    MovedBand band = moved_by(reference_, dx, dy);
    band.step = row_step(band.width, band.height);
    std::vector<Sum> sums;
    for (const RowBand& part : bands_) {
      const int ahead = std::max(0, part.rows.first - border);
      band.first = border + (ahead + band.step - 1) / band.step * band.step;
      const int last = std::min(part.rows.last, band.height - border);
      band.rows = std::max(0, (last - band.first + band.step - 1) / band.step);
      band.top = band.moving_top = part.rows.top;
      const auto spans = static_cast<std::size_t>((band.width + kColumns - 1) / kColumns);
      sums.resize(spans * static_cast<std::size_t>(band.rows));
      const gl::Buffer made = queue_.buffer<Sum>(sums.size());
      queue_.run(kMoved, pass, sums.size(), band,
                 {&part.reference, &part.moving, &made, &made, &made});
      queue_.read(made, std::span(sums));
      for (const Sum& s : sums) add(s);
    }
  }

  gl::Queue& queue_;
  FrameView reference_;
  std::vector<RowBand> bands_;
};

Shift search_on(gl::Queue& queue, const EstimateShift::Args& args) {
  const std::size_t levels = std::min(args.reference.size(), args.moving.size());
  // A level finds a pixel more than twice what the one above did.
  const int farthest = args.max_shift + (1 << levels) + 2;
  std::vector<DevicePair> pairs;
  for (std::size_t i = 0; i < levels; ++i) {
    pairs.emplace_back(queue, args.reference[i], args.moving[i], farthest);
  }
  const auto pair_of = [&](FrameView reference) -> const DevicePair& {
    return *std::ranges::find_if(pairs, [&](const auto& p) { return p.shows(reference); });
  };
  return search_shift(
      args,
      [&](FrameView reference, FrameView, double dx, double dy) {
        return pair_of(reference).difference(dx, dy);
      },
      [&](FrameView reference, FrameView, double dx, double dy) {
        return pair_of(reference).equations(dx, dy);
      });
}

}  // namespace

void Halve::egl(const Args& args, gl::Context& context) {
  if (args.half.empty()) return;
  HalfBand band{args.image.width, args.half.width, 0};
  const std::size_t row = 2 * sizeof(float) * static_cast<std::size_t>(args.image.width);
  context.run([&](gl::Queue& queue) {
    gl::each_band(queue, args.half.height, row, 0, [&](const gl::Band& part) {
      band.pixels = static_cast<uint>(band.half_width) * static_cast<uint>(part.last - part.first);
      const gl::Buffer sent = queue.upload(gl::rows(args.image, 2 * part.first, 2 * part.last)),
                       half = queue.buffer<float>(band.pixels);
      queue.run(shaders::prepare_frame_halve, "halve", band.pixels, band, {&sent, &half});
      queue.read(half, gl::rows(args.half, part.first, part.last));
    });
  });
}

void EstimateShift::egl(const Args& args, gl::Context& context) {
  *args.shift = {};
  if (args.reference[0].empty()) return;
  context.run([&](gl::Queue& queue) { *args.shift = search_on(queue, args); });
}

void ShiftImage::egl(const Args& args, gl::Context& context) {
  if (args.image.empty()) return;
  MovedBand band = moved_by(args.image, args.dx, args.dy);
  const std::size_t row = sizeof(float) * static_cast<std::size_t>(band.width);
  context.run([&](gl::Queue& queue) {
    // A row is made of two; both lie somewhere else.
    gl::each_band(queue, band.height, row, 1, [&](const gl::Band& part) {
      band.first = part.first, band.rows = part.last - part.first;
      band.moving_top = std::clamp(part.first + band.iy, 0, band.height);
      const int bottom = std::clamp(part.last + band.iy + 1, band.moving_top, band.height);
      const gl::Buffer sent = queue.upload(gl::rows(args.image, band.moving_top, bottom)),
                       moved = queue.buffer<float>(static_cast<std::size_t>(band.width) *
                                                   static_cast<std::size_t>(band.rows));
      queue.run(kMoved, "shift",
                static_cast<std::size_t>(band.width) * static_cast<std::size_t>(band.rows), band,
                {&sent, &sent, &moved});
      queue.read(moved, gl::rows(args.moved, part.first, part.last));
    });
  });
}

}  // namespace glint
