// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/filters/search_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "glint/engine/filters/moved_particles.hpp"
#include "glint/engine/filters/particle_steps.hpp"
#include "glint/kernels/cell_weights/bound.hpp"
#include "glint/kernels/core/math.hpp"

namespace glint {
namespace {

BirthProposal proposal_of(const std::string& name) {
  if (name == "uniform") return BirthProposal::uniform;
  return name == "matched-filter" ? BirthProposal::matched_filter : BirthProposal::two_frame;
}

std::uint64_t index_of(std::int64_t frame) { return static_cast<std::uint64_t>(frame); }

BirthConfig births_of(const SearchConfig& config) {
  BirthConfig births;
  births.proposal = proposal_of(config.birth);
  births.count = config.birth_particles;
  births.mass = config.birth_mass;
  births.threshold = config.birth_threshold;
  births.speed_max = config.speed_max;
  return births;
}

}  // namespace

MotionBank MotionConfig::bank() const {
  return motion_bank(motion, process_noise, turn_rate * std::numbers::pi / 180);
}

SearchCloud::SearchCloud(const SearchConfig& config, const Device& device, std::uint64_t seed,
                         CloudWeight weight)
    : config_(config),
      bank_(config.bank()),
      device_(device),
      seed_(seed),
      weight_(weight),
      appearance_(config),
      births_(births_of(config), bank_, device, seed) {}

void SearchCloud::set_appearance(const TargetAppearance& appearance) {
  appearance_ = appearance;
  births_.set_appearance(appearance);
  clear();  // intensities were for another shape
}

void SearchCloud::clear() {
  particles_.resize(0);
  expected_ = 0;
}

void SearchCloud::predict(const Frame& z, std::int64_t frame, double step, const PixelMask& mask,
                          std::span<const float> noise_scale) {
  auto& p = particles_;
  move_particles({bank_, appearance_, device_, seed_}, frame, step, p, noise_scale);
  // P-PHD (11): survivors keep w_{k-1}, times the probability of survival.
  const auto survival = static_cast<float>(config_.survival);
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.weight[i] = !mask.empty() && mask.covers(p.x[i], p.y[i]) ? 0 : p.weight[i] * survival;
  }
  give_birth(z, frame, step, mask);
}

void SearchCloud::give_birth(const Frame& z, std::int64_t frame, double step,
                             const PixelMask& mask) {
  const std::size_t survivors = particles_.size();
  const std::size_t all = survivors + static_cast<std::size_t>(config_.birth_particles);
  const auto from = static_cast<std::ptrdiff_t>(survivors);
  particles_.resize(all);
  for (auto* zero : {&particles_.ax, &particles_.ay}) {
    std::fill(zero->begin() + from, zero->end(), 0.0f);
  }
  std::fill(particles_.label.begin() + from, particles_.label.end(), 0u);
  const std::size_t born =
      births_.draw({z, frame, step, cells_, config_.clutter, mask}, particles_, survivors);
  particles_.resize(survivors + born);
}

void SearchCloud::update(const Frame& z, std::int64_t frame) {
  auto& p = particles_;
  log_ratio_.resize(p.size());
  updated_.resize(p.size());
  weigh_particles({bank_, appearance_, device_, seed_}, z, frame, p, log_ratio_);
  device_.run<CellWeights>({.width = z.width(),
                            .height = z.height(),
                            .half_width = appearance_.spread().half_width,
                            .psi = config_.psi == "cell" ? Psi::cell : Psi::window,
                            .clutter = static_cast<float>(config_.clutter),
                            .x = p.x,
                            .y = p.y,
                            .predicted = p.weight,
                            .log_ratio = log_ratio_,
                            .updated = updated_,
                            .workspace = &cells_});
  std::swap(p.weight, updated_);
  expected_ = total_mass(cells_.runs);
  const bool odds = weight_ == CloudWeight::odds;
  if (odds || config_.resample_on == "likelihood") weigh_by_likelihood();
  if (odds) turn_to_odds();
}

void SearchCloud::turn_to_odds() {
  constexpr double kMost = 1e8;  // nothing is surer than that
  const double sum = std::accumulate(cells_.cell_sum.begin(), cells_.cell_sum.end(), 0.0);
  const auto scale = static_cast<float>(sum > kMost ? kMost / sum : 1);
  for (float& w : likelihood_) w *= scale;
  for (std::size_t r = 0; r < cells_.runs.size(); ++r) {
    cells_.runs.mass[r] = scale * cells_.cell_sum[r];
  }
  particles_.weight = likelihood_;
  expected_ = std::min(sum, kMost);
}

void SearchCloud::weigh_by_likelihood() {
  const auto& predicted = updated_;  // the update left them there
  likelihood_.resize(predicted.size());
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    const bool possible = log_ratio_[i] >= -kMaxLogRatio;  // false for NaN
    likelihood_[i] = possible ? predicted[i] * math::exp(bounded_log_ratio(log_ratio_[i])) : 0.0f;
  }
}

void SearchCloud::remove(std::span<const std::uint32_t> members) {
  for (const std::uint32_t i : members) {
    expected_ -= particles_.weight[i];
    particles_.weight[i] = 0;
    if (!likelihood_.empty()) likelihood_[i] = 0;
  }
  expected_ = std::max(0.0, expected_);
}

void SearchCloud::resample(std::int64_t frame) {
  auto& p = particles_;
  const double targets = weight_ == CloudWeight::odds ? 1 : std::max(1.0, std::ceil(expected_));
  const double wanted =
      std::min({targets * config_.particles_per_target, static_cast<double>(config_.particles_max),
                static_cast<double>(p.size())});
  const std::size_t kept = expected_ > 0 ? static_cast<std::size_t>(wanted) : 0;
  moved_.resize(kept);
  ancestors_.resize(kept);
  if (kept > 0) {
    const auto moves = moved_particles(p, 0, moved_, 0);
    device_.run<Resample>(
        {.weights = likelihood_.empty() ? p.weight : likelihood_,
         .ancestors = ancestors_,
         .method = config_.resampling == "residual" ? Resampling::residual : Resampling::systematic,
         .key = random_key(seed_, index_of(frame), Purpose::resample),
         .moved = moves,
         .workspace = &draws_});
    std::fill(moved_.weight.begin(), moved_.weight.end(),
              static_cast<float>(expected_ / static_cast<double>(kept)));
  }
  std::swap(particles_, moved_);
}

}  // namespace glint
