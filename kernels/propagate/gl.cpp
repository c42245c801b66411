// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <iterator>

#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/propagate/draws.hpp"
#include "glint/kernels/propagate/transition.hpp"
#include "glint_shaders/propagate.hpp"

namespace glint {
namespace {

#include "glint/kernels/propagate/pass.glsl"
using propagate::Move;
using propagate::Transition;
static_assert(std::size(DeviceStep{}.move) == Propagate::kMaxModes);

DeviceStep step_of(const Propagate::Args& args) {
  const Transition<float> t = propagate::narrowed(propagate::transition_of(args));
  DeviceStep step{};
  step.key = words_of(random_key(args.seed, args.frame, Purpose::propagate));
  step.switch_key = words_of(random_key(args.seed, args.frame, Purpose::switch_model));
  step.modes = static_cast<uint>(t.modes);
  step.accelerates = t.accelerates ? 1 : 0;
  step.scaled = args.noise_scale.empty() ? 0 : 1;
  step.intensity_deviation = t.intensity_deviation;
  step.intensity_low = args.intensity_low, step.intensity_high = args.intensity_high;
  for (std::size_t m = 0; m < Propagate::kMaxModes; ++m) {
    step.move[m] = std::bit_cast<MoveTerms>(t.move[m]);
    std::copy_n(t.cumulative[m], Propagate::kMaxModes, step.cumulative + m * Propagate::kMaxModes);
  }
  return step;
}

/// Particles [step.first, step.first + step.count). Arrays that the step does not look at
/// are empty.
void run_piece(gl::Queue& queue, const Propagate::Args& args, const DeviceStep& step) {
  const auto piece = [&](auto values, bool used) {
    return used ? values.subspan(step.first, step.count) : values.first(0);
  };
  const bool accelerates = step.accelerates != 0;
  const std::array floats{piece(args.x, true),         piece(args.y, true),
                          piece(args.vx, true),        piece(args.vy, true),
                          piece(args.intensity, true), piece(args.ax, accelerates),
                          piece(args.ay, accelerates)};
  const auto modes = piece(args.mode, step.modes > 1);
  const auto scales = piece(args.noise_scale, step.scaled != 0);
  const gl::Buffer x = queue.upload(floats[0]), y = queue.upload(floats[1]),
                   vx = queue.upload(floats[2]), vy = queue.upload(floats[3]),
                   intensity = queue.upload(floats[4]), ax = queue.upload(floats[5]),
                   ay = queue.upload(floats[6]), mode = queue.upload(modes),
                   scale = queue.upload(scales);
  const std::array moved{&x, &y, &vx, &vy, &intensity, &ax, &ay};
  queue.run(shaders::propagate, "move", step.count, step,
            {&x, &y, &vx, &vy, &intensity, &ax, &ay, &mode, &scale});
  for (std::size_t i = 0; i < moved.size(); ++i) queue.read(*moved[i], floats[i]);
  queue.read(mode, modes);
}

}  // namespace

void Propagate::egl(const Args& args, gl::Context& context) {
  propagate::check(args);
  DeviceStep step = step_of(args);
  context.run([&](gl::Queue& queue) {
    const Tiles pieces{args.x.size(), queue.max_bytes() / sizeof(uint)};
    for (std::size_t p = 0; p < pieces.tiles(); ++p) {
      step.first = static_cast<uint>(pieces.begin(p));
      step.count = static_cast<uint>(pieces.end(p) - pieces.begin(p));
      run_piece(queue, args, step);
    }
  });
}

}  // namespace glint
