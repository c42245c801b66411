// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/data.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "glint/kernels/core/random.hpp"

namespace glint::bench {
namespace {

Normals4 normals(std::uint32_t item, std::uint32_t draw, std::uint32_t frame = 0) {
  return random_normals(random_key(1, frame, Purpose::trial), item, draw);
}
Words4 words(std::uint32_t item, std::uint32_t draw) {
  return random_words(random_key(2, 0, Purpose::trial), item, draw);
}

// f(x, y, z) with unit white noise z for every pixel.
template <class F>
void for_noise(int width, int height, std::uint32_t frame, const F& f) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; x += 4) {
      const Normals4 z =
          normals(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), frame);
      for (int k = 0; k < std::min(4, width - x); ++k) f(x + k, y, z.n[k]);
    }
  }
}

void fill_rest(Particles& p) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Normals4 z = normals(static_cast<std::uint32_t>(i), 1);
    p.vx[i] = z.n[0];
    p.vy[i] = z.n[1];
    p.intensity[i] = std::max(1.0f, 10 + 2 * z.n[2]);
    p.weight[i] = z.n[3] * z.n[3];
  }
}

}  // namespace

Image<float> noise_frame(int width, int height, std::uint32_t frame) {
  Image<float> image(width, height);
  const auto view = image.view();
  for_noise(width, height, frame, [&](int x, int y, float z) { view(x, y) = z; });
  return image;
}

Image<std::uint16_t> sensor_frame(int width, int height, std::uint32_t frame) {
  Image<std::uint16_t> image(width, height);
  const auto view = image.view();
  for_noise(width, height, frame, [&](int x, int y, float z) {
    view(x, y) = static_cast<std::uint16_t>(std::lround(kSensorOffset + kSensorScale * z));
  });
  return image;
}

Particles clouds(std::size_t n, int targets, int width, int height) {
  Particles p;
  p.resize(n);
  const float margin = 100;
  for (std::size_t i = 0; i < n; ++i) {
    const auto target = static_cast<std::uint32_t>(i * static_cast<std::size_t>(targets) / n);
    const Words4 place = words(target, 0);
    const Normals4 z = normals(static_cast<std::uint32_t>(i), 0);
    p.x[i] = margin + uniform(place.w[0]) * (static_cast<float>(width) - 2 * margin) + 3 * z.n[0];
    p.y[i] = margin + uniform(place.w[1]) * (static_cast<float>(height) - 2 * margin) + 3 * z.n[1];
  }
  fill_rest(p);
  return p;
}

Particles spread_particles(std::size_t n, int width, int height, Order order) {
  AlignedVector<float> x(n), y(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Words4 place = words(static_cast<std::uint32_t>(i), 1);
    x[i] = uniform(place.w[0]) * static_cast<float>(width - 1);
    y[i] = uniform(place.w[1]) * static_cast<float>(height - 1);
  }
  std::vector<std::uint32_t> index(n);
  std::iota(index.begin(), index.end(), 0u);
  if (order == Order::tiles) {
    const auto key = [&](std::uint32_t i) {
      const auto row = static_cast<std::uint64_t>(y[i]), column = static_cast<std::uint64_t>(x[i]);
      return (row / 32) << 40 | (column / 128) << 20 | row;
    };
    std::stable_sort(index.begin(), index.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  }
  Particles p;
  p.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    p.x[i] = x[index[i]];
    p.y[i] = y[index[i]];
  }
  fill_rest(p);
  return p;
}

AlignedVector<float> random_weights(std::size_t n) {
  AlignedVector<float> weights(n);
  for (std::size_t i = 0; i < n; ++i) {
    const float e = -math::log(uniform(words(static_cast<std::uint32_t>(i), 2).w[0]));
    weights[i] = e * e;
  }
  return weights;
}

}  // namespace glint::bench
