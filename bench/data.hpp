// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "glint/kernels/core/aligned.hpp"
#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/particles.hpp"

/// Problems of the sizes that PERFORMANCE.md speaks of, the same in every run.
namespace glint::bench {

/// Unit white noise.
Image<float> noise_frame(int width, int height, std::uint32_t frame = 0);
/// The same noise as a sensor would deliver it: kSensorOffset + kSensorScale z, rounded.
Image<std::uint16_t> sensor_frame(int width, int height, std::uint32_t frame = 0);
inline constexpr float kSensorOffset = 1000, kSensorScale = 50;

/// `n` particles in clouds (sigma 3 px) around `targets` places at least 100 px inside the frame,
/// one cloud after the other, as a tracker keeps them; unit velocities, intensity about 10, random
/// weights.
Particles clouds(std::size_t n, int targets, int width, int height);

enum class Order { random, tiles };
/// `n` particles all over the frame, in random order or sorted by 128 x 32 pixel tile and row.
Particles spread_particles(std::size_t n, int width, int height, Order order);

/// Heavy-tailed positive weights.
AlignedVector<float> random_weights(std::size_t n);

/// All elements from the first pixel to the last, padding included: what a pass over an image's
/// memory touches.
template <class T>
std::span<T> memory_of(ImageView<T> image) {
  return {image.data,
          static_cast<std::size_t>(image.pitch) * static_cast<std::size_t>(image.height)};
}

}  // namespace glint::bench
