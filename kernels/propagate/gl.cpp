// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
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

/// Calls f(array, values) for each array of floats that the step changes.
template <class F>
void each_array(const Propagate::Args& args, const DeviceStep& step, const F& f) {
  f(kX, args.x), f(kY, args.y), f(kVx, args.vx), f(kVy, args.vy), f(kIntensity, args.intensity);
  if (step.accelerates != 0) f(kAx, args.ax), f(kAy, args.ay);
}

void run_piece(gl::Queue& queue, const Propagate::Args& args, const DeviceStep& step) {
  const std::size_t first = step.first, count = step.count;
  const gl::Buffer state = queue.buffer<uint>(kArrays * count);
  each_array(args, step, [&](uint array, std::span<float> values) {
    queue.write(state, std::span<const float>(values.subspan(first, count)), array * count);
  });
  if (step.scaled != 0) queue.write(state, args.noise_scale.subspan(first, count), kScale * count);
  const auto modes = step.modes > 1 ? args.mode.subspan(first, count) : std::span<uint>{};
  queue.write(state, std::span<const uint>(modes), kMode * count);
  queue.run(shaders::propagate, "move", count, step, {&state});
  each_array(args, step, [&](uint array, std::span<float> values) {
    queue.read(state, values.subspan(first, count), array * count);
  });
  queue.read(state, modes, kMode * count);
}

}  // namespace

void Propagate::egl(const Args& args, gl::Context& context) {
  propagate::check(args);
  DeviceStep step = step_of(args);
  context.run([&](gl::Queue& queue) {
    const Tiles pieces{args.x.size(), queue.max_bytes() / (sizeof(uint) * kArrays)};
    for (std::size_t p = 0; p < pieces.tiles(); ++p) {
      step.first = static_cast<uint>(pieces.begin(p));
      step.count = static_cast<uint>(pieces.end(p) - pieces.begin(p));
      run_piece(queue, args, step);
    }
  });
}

}  // namespace glint
