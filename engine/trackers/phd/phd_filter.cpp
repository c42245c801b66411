// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/phd_filter.hpp"

#include <algorithm>
#include <cmath>

#include "glint/engine/trackers/phd/cued_particles.hpp"
#include "glint/engine/trackers/phd/particle_steps.hpp"
#include "glint/engine/trackers/phd/resident_particles.hpp"

namespace glint {
namespace {

constexpr double kMostOdds = 1e8;  // of a particle, in the next frame

std::uint64_t index_of(std::int64_t frame) { return static_cast<std::uint64_t>(frame); }

}  // namespace

PhdFilter::PhdFilter(const PhdFilterConfig& config, const Device& device, std::uint64_t seed,
                     WeightSum weight_sum)
    : config_(config),
      bank_(config.bank()),
      device_(device),
      seed_(seed),
      weight_sum_(weight_sum),
      appearance_(config),
      births_(config, config, device, seed),
      particles_(device),
      moved_(device),
      log_ratio_(device),
      updated_(device),
      drawn_by_(device),
      ancestors_(device) {}

void PhdFilter::set_appearance(const TargetAppearance& appearance) {
  appearance_ = appearance;
  births_.set_appearance(appearance);
  clear();
}

void PhdFilter::restored() const {
  require_particles(particles_.arrays(), bank_.modes.size());
  require_bytes(cells_.runs.cell.size() == cells_.cell_sum.size(), "cells and sums do not fit");
}

void PhdFilter::clear() {
  particles_.resize(0);
  expected_ = 0;
}

Particles& PhdFilter::particles() {
  if (!fetched_) particles_.fetch();
  fetched_ = true;
  return particles_.arrays();
}

std::span<const std::uint32_t> PhdFilter::labels() {
  const auto& label = particles_.arrays().label;
  if (!fetched_) device_.fetch(std::span(label));
  return label;
}

void PhdFilter::send_labels() { device_.send(std::span(particles_.arrays().label)); }

void PhdFilter::predict(const Frame& z, std::int64_t frame, double step, const PixelMask& mask,
                        std::span<const float> noise_scale) {
  move_particles({bank_, appearance_, device_, seed_}, frame, step, particles_.arrays(),
                 noise_scale);
  set_survivors(mask);
  give_birth(z, frame, step, mask);
  fetched_ = false;
}

// P-PHD (11): survivors keep w_{k-1}, times the probability of survival.
void PhdFilter::set_survivors(const PixelMask& mask) {
  auto& p = particles_.arrays();
  const auto survival = static_cast<float>(config_.survival);
  const float weight = weight_of_each_ * survival;
  if (mask.empty() && !odds()) return device_.fill(p.weight, weight);
  device_.fetch(std::span(p.x)), device_.fetch(std::span(p.y));
  if (odds()) device_.fetch(std::span(p.weight));
  for (std::size_t i = 0; i < p.size(); ++i) {
    const float alive = odds() ? p.weight[i] * survival : weight;
    p.weight[i] = mask.covers(p.x[i], p.y[i]) ? 0 : alive;
  }
  device_.send(std::span(p.weight));
}

void PhdFilter::give_birth(const Frame& z, std::int64_t frame, double step, const PixelMask& mask) {
  const std::size_t survivors = particles_.size();
  const BirthScan scan{z, frame, step, cells_, config_.clutter, mask};
  particles_.resize(survivors + births_.prepare(scan));
  births_.draw(scan, particles_.arrays(), survivors);
}

void PhdFilter::add(const Cue& cue, const StepTime& at, double mass, std::uint32_t label) {
  const std::size_t first = particles_.size();
  const auto count = static_cast<std::size_t>(config_.particles_per_target);
  particles_.resize(first + count);
  Particles& p = particles_.arrays();
  const RandomKey key =
      random_key(seed_ ^ (std::uint64_t{label} << 32), index_of(at.frame), Purpose::cue);
  draw_cued({bank_, appearance_, config_.speed_max, key}, cue, at, p, first, count);
  const auto begin = static_cast<std::ptrdiff_t>(first);
  std::fill_n(p.weight.begin() + begin, count,
              static_cast<float>(mass / config_.particles_per_target));
  std::fill_n(p.label.begin() + begin, count, label);
  p.for_each_array([&](auto& a) { device_.send(std::span(a).subspan(first, count)); });
}

void PhdFilter::update(const Frame& z, std::int64_t frame) {
  auto& p = particles_.arrays();
  log_ratio_.resize(p.size());
  updated_.resize(p.size());
  if (odds() || config_.resample_on == ResampleOn::likelihood) drawn_by_.resize(p.size());
  weigh_particles({bank_, appearance_, device_, seed_}, z, frame, p, log_ratio_.values());
  device_.run<CellWeights>({.width = z.width(),
                            .height = z.height(),
                            .half_width = appearance_.spread().half_width,
                            .psi = config_.psi,
                            .clutter = static_cast<float>(config_.clutter),
                            .x = p.x,
                            .y = p.y,
                            .predicted = p.weight,
                            .log_ratio = log_ratio_.values(),
                            .updated = updated_.values(),
                            .weighted = drawn_by_.values(),
                            .workspace = &cells_});
  particles_.swap_weight(updated_);
  expected_ = total_mass(cells_.runs);
  if (odds()) {
    // The odds of one bright target would take all particles; the share in its pixels is 1 at most.
    particles_.swap_weight(drawn_by_);
    cells_.runs.mass.assign(cells_.cell_sum.begin(), cells_.cell_sum.end());
    bound_odds();
  }
  fetched_ = false;
}

/// Beyond the range of float there is no share in a pixel any more: each particle there then counts
/// alike.
void PhdFilter::bound_odds() {
  constexpr float kFinite = 1e30F;
  const auto finite = [](float v) { return v < kFinite; };  // false for NaN
  if (std::ranges::all_of(cells_.runs.mass, finite)) return;
  for (float& mass : cells_.runs.mass) mass = finite(mass) ? mass : kFinite;
  auto& weight = particles().weight;
  drawn_by_.fetch();
  expected_ = 0;
  for (std::size_t i = 0; i < weight.size(); ++i) {
    float& share = drawn_by_.values()[i];
    if (!(share >= 0 && share <= 1) || !finite(weight[i])) {
      share = 1 / static_cast<float>(config_.particles_per_target);
    }
    weight[i] = finite(weight[i]) ? weight[i] : kFinite;
    expected_ += share;
  }
  device_.send(std::span(weight));
  drawn_by_.send();
}

void PhdFilter::remove(std::span<const std::uint32_t> members) {
  auto& weight = particles().weight;
  drawn_by_.fetch();
  for (const std::uint32_t i : members) {
    expected_ -= odds() ? drawn_by_.values()[i] : weight[i];
    weight[i] = 0;
    if (!drawn_by_.empty()) drawn_by_.values()[i] = 0;
  }
  device_.send(std::span(weight));
  drawn_by_.send();
  expected_ = std::max(0.0, expected_);
}

void PhdFilter::resample(std::int64_t frame) {
  auto& p = particles_.arrays();
  const double targets = std::max(1.0, std::ceil(expected_));
  const double wanted =
      std::min({targets * config_.particles_per_target, static_cast<double>(config_.particles_max),
                static_cast<double>(p.size())});
  const std::size_t kept = expected_ > 0 ? static_cast<std::size_t>(wanted) : 0;
  moved_.resize(kept);
  ancestors_.resize(kept);
  if (kept > 0) {
    const auto moves = moved_particles(p, 0, moved_.arrays(), 0);
    device_.run<Resample>(
        {.weights = drawn_by_.empty() ? std::span<const float>(p.weight) : drawn_by_.values(),
         .ancestors = ancestors_.values(),
         .method = config_.resampling,
         .key = random_key(seed_, index_of(frame), Purpose::resample),
         .moved = moves,
         .workspace = &draws_});
    weigh_anew(kept);
  }
  std::swap(particles_, moved_);
  fetched_ = false;
}

/// Of `kept` particles: all alike; odds w over the number of times that each is drawn on average.
void PhdFilter::weigh_anew(std::size_t kept) {
  const double each = expected_ / static_cast<double>(kept);
  weight_of_each_ = static_cast<float>(each);
  if (!odds()) return device_.fill(moved_.arrays().weight, weight_of_each_);
  ancestors_.fetch(), drawn_by_.fetch();
  const auto& weight = particles().weight;
  for (std::size_t i = 0; i < kept; ++i) {
    const std::uint32_t from = ancestors_.values()[i];
    const float share = drawn_by_.values()[from];
    const double odds =
        share > 0 ? each * weight[from] / share : 0;  // none left: drawn all the same
    moved_.arrays().weight[i] = static_cast<float>(std::min(odds, kMostOdds));
  }
  device_.send(std::span(moved_.arrays().weight));
}

}  // namespace glint
