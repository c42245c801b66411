// SPDX-License-Identifier: Apache-2.0
// How new-born particles are drawn.
#include <algorithm>
#include <cmath>

#include "glint/engine/trackers/phd/births.hpp"
#include "glint/engine/trackers/phd/cued_particles.hpp"
#include "glint/kernels/core/cells.hpp"
#include "glint/kernels/core/random.hpp"
#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/particle_likelihood/particle_likelihood.hpp"
#include "glint/kernels/pick_cells/pick_cells.hpp"

namespace glint {
namespace {

constexpr std::size_t kBirthTile = 512;

/// M summed over the window around a pixel that need not hold a particle.
double window_sum(const CellWorkspace& cells, int width, int height, int half_width, int x, int y) {
  const auto& cell = cells.runs.cell;
  double sum = 0;
  for (int j = std::max(0, y - half_width); j <= std::min(height - 1, y + half_width); ++j) {
    const auto first = cell_at(std::max(0, x - half_width), j, width);
    const auto last = cell_at(std::min(width - 1, x + half_width), j, width);
    auto r =
        static_cast<std::size_t>(std::lower_bound(cell.begin(), cell.end(), first) - cell.begin());
    for (; r < cell.size() && cell[r] <= last; ++r) sum += cells.cell_sum[r];
  }
  return sum;
}

}  // namespace

std::uint32_t Births::draw_mode(std::uint32_t word) const { return drawn_mode(birth_mode_, word); }

float Births::draw_intensity(std::uint32_t word) const {
  return drawn_intensity(intensity_low_, intensity_high_, word);
}

/// Completes the new-born particles from index `at` on and sends them to the device.
void Births::send(Particles& particles, std::size_t at) const {
  for (auto* zero : {&particles.ax, &particles.ay}) {
    std::fill_n(zero->begin() + static_cast<std::ptrdiff_t>(at), count_, 0.0F);
  }
  std::fill_n(particles.label.begin() + static_cast<std::ptrdiff_t>(at), count_, 0U);
  particles.for_each_array([&](auto& a) { device_.send(std::span(a).subspan(at, count_)); });
}

void Births::draw_uniform(const BirthScan& scan, Particles& p, std::size_t at) {
  const FrameView z = scan.z.view();
  const RandomKey key = random_key(seed_, static_cast<std::uint64_t>(scan.frame), Purpose::birth);
  const auto speed = static_cast<float>(speed_max_);
  for (std::size_t i = 0; i < count_; ++i) {
    const Words4 a = random_words(key, static_cast<std::uint32_t>(i), 0);
    const Words4 b = random_words(key, static_cast<std::uint32_t>(i), 1);
    const auto pick = static_cast<std::size_t>(uniform(a.w[0]) * static_cast<float>(cells_.size()));
    const Pixel cell = pixel_at(cells_[std::min(pick, cells_.size() - 1)], z.width);
    const std::size_t to = at + i;
    // Around the cell: the target may peak in a neighbour of the cell that noise lifted.
    p.x[to] = static_cast<float>(cell.x) + 3 * uniform(a.w[1]) - 1.5f;
    p.y[to] = static_cast<float>(cell.y) + 3 * uniform(a.w[2]) - 1.5f;
    p.vx[to] = speed * (2 * uniform(b.w[0]) - 1);
    p.vy[to] = speed * (2 * uniform(b.w[1]) - 1);
    p.intensity[to] = draw_intensity(b.w[2]);
    p.mode[to] = draw_mode(b.w[3]);
    p.weight[to] = static_cast<float>(config_.birth_mass / config_.birth_particles);  // P-PHD (30)
  }
  send(p, at);
}

/// `count` cells in proportion to their scores.
void Births::draw_cells(const BirthFrame& frame, RandomKey key) {
  cells_.resize(count_), cell_score_.resize(count_);
  const MovedArray scores{frame.score.values().data(), cell_score_.data()};
  device_.run<Resample>({.weights = frame.score.values(),
                         .ancestors = cells_,
                         .key = key,
                         .moved = std::span(&scores, 1),
                         .workspace = &draws_});
}

/// For each of these cells of the frame before one of the present frame that a target may reach.
void Births::pick_next_cells(RandomKey key, double step) {
  const auto count = cells_.size();
  uniform_.resize(count), next_cells_.resize(count);
  next_score_.resize(count), next_total_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    uniform_[i] = uniform(random_words(key, static_cast<std::uint32_t>(i), 1).w[2]);
  }
  const int width = now_.whitened.width(), height = now_.whitened.height();
  device_.run<PickCells>({.score = {now_.score.values().data(), width, height, width},
                          .reach = static_cast<int>(std::ceil(speed_max_ * step)),
                          .cell = cells_,
                          .uniform = uniform_,
                          .picked = next_cells_,
                          .picked_score = next_score_,
                          .total = next_total_});
}

void Births::draw_matched(const BirthScan& scan, Particles& p, std::size_t at) {
  const int width = now_.whitened.width(), height = now_.whitened.height();
  const RandomKey key = random_key(seed_, static_cast<std::uint64_t>(scan.frame), Purpose::birth);
  const auto speed = static_cast<float>(speed_max_);
  draw_cells(now_, key);
  const double mean = now_.total / (static_cast<double>(width) * height);
  const double mass = config_.birth_mass / static_cast<double>(count_);
  for (std::size_t i = 0; i < count_; ++i) {
    const Words4 a = random_words(key, static_cast<std::uint32_t>(i), 1);
    const Words4 b = random_words(key, static_cast<std::uint32_t>(i), 2);
    const Pixel cell = pixel_at(cells_[i], width);
    const std::size_t to = at + i;
    p.x[to] = static_cast<float>(cell.x) + uniform(a.w[0]) - 0.5f;
    p.y[to] = static_cast<float>(cell.y) + uniform(a.w[1]) - 0.5f;
    p.vx[to] = speed * (2 * uniform(b.w[0]) - 1);
    p.vy[to] = speed * (2 * uniform(b.w[1]) - 1);
    p.intensity[to] = draw_intensity(b.w[2]);
    p.mode[to] = draw_mode(b.w[3]);
    p.weight[to] = static_cast<float>(mass * mean / cell_score_[i]);
  }
  send(p, at);
}

void Births::draw_two_frame(const BirthScan& scan, Particles& p, std::size_t at) {
  const double step = scan.step;
  const int width = now_.whitened.width(), height = now_.whitened.height();
  const RandomKey key = random_key(seed_, static_cast<std::uint64_t>(scan.frame), Purpose::birth);
  const std::size_t count = count_;
  for (auto* v : {&x_before_, &y_before_, &log_ratio_}) v->resize(count);
  draw_cells(before_, key);
  pick_next_cells(key, step);

  const double mean = before_.total / (static_cast<double>(width) * height);
  const double mass = config_.birth_mass / static_cast<double>(count);
  const double area = 4 * speed_max_ * step * speed_max_ * step;
  const Tiles tiles{count, kBirthTile};
  device_.workers().for_tiles(tiles.tiles(), [&](std::size_t tile) {
    for (std::size_t i = tiles.begin(tile); i < tiles.end(tile); ++i) {
      const Words4 a = random_words(key, static_cast<std::uint32_t>(i), 1);
      const Words4 b = random_words(key, static_cast<std::uint32_t>(i), 2);
      const auto [cx, cy] = pixel_at(cells_[i], width);
      const Pixel next = pixel_at(next_cells_[i], width);
      const double next_score = next_score_[i];
      const std::size_t to = at + i;
      x_before_[i] = static_cast<float>(cx) + uniform(a.w[0]) - 0.5f;
      y_before_[i] = static_cast<float>(cy) + uniform(a.w[1]) - 0.5f;
      p.x[to] = static_cast<float>(next.x) + uniform(b.w[0]) - 0.5f;
      p.y[to] = static_cast<float>(next.y) + uniform(b.w[1]) - 0.5f;
      p.vx[to] = static_cast<float>((p.x[to] - x_before_[i]) / step);
      p.vy[to] = static_cast<float>((p.y[to] - y_before_[i]) / step);
      p.intensity[to] = draw_intensity(b.w[2]);
      p.mode[to] = draw_mode(b.w[3]);
      // What living targets already explain of this cell is no birth: 1 / (clutter + B).
      const double explained =
          scan.clutter + window_sum(scan.previous, width, height, spread_.half_width, cx, cy);
      const bool possible =  // all cells in reach may be masked
          next_score > 0 && std::abs(p.vx[to]) <= speed_max_ && std::abs(p.vy[to]) <= speed_max_;
      const double weight =
          mass * mean / cell_score_[i] * next_total_[i] / (area * next_score) / explained;
      p.weight[to] = possible ? static_cast<float>(weight) : 0.0f;
    }
  });
  send(p, at);
  device_.run<ParticleLikelihood>(
      {.frame = before_.whitened.for_kernels(),
       .spread = spread_,
       .x = x_before_,
       .y = y_before_,
       .intensity = std::span(p.intensity).subspan(at, count),
       .log_ratio = log_ratio_,
       .jitter = jitter_,
       .key = random_key(seed_, static_cast<std::uint64_t>(scan.frame), Purpose::birth_jitter)});
  // The new-born already lived a frame ago and share its pixels, so P-PHD (14) holds for them too.
  const std::span<float> predicted = std::span(p.weight).subspan(at, count);
  updated_.resize(count);
  device_.run<CellWeights>({.width = width,
                            .height = height,
                            .half_width = spread_.half_width,
                            .clutter = 1,
                            .x = x_before_,
                            .y = y_before_,
                            .predicted = predicted,
                            .log_ratio = log_ratio_,
                            .updated = updated_,
                            .workspace = &shares_});
  std::copy(updated_.begin(), updated_.end(), predicted.begin());
  device_.send(predicted);
}

}  // namespace glint
