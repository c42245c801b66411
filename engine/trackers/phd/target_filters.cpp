// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/target_filters.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "glint/engine/state/bytes.hpp"
#include "glint/engine/trackers/phd/cued_particles.hpp"
#include "glint/engine/trackers/phd/particle_steps.hpp"
#include "glint/engine/trackers/phd/resident_particles.hpp"
#include "glint/kernels/cell_weights/bound.hpp"

namespace glint {
namespace {

std::uint64_t index_of(std::int64_t frame) { return static_cast<std::uint64_t>(frame); }

}  // namespace

TargetFilters::TargetFilters(const MotionBank& bank, int count, const Device& device,
                             std::uint64_t seed)
    : bank_(bank),
      count_(static_cast<std::size_t>(count)),
      device_(device),
      seed_(seed),
      appearance_(AppearanceConfig{}) {}

void TargetFilters::set_appearance(const TargetAppearance& appearance) {
  const auto rescale = static_cast<float>(appearance.spread().intensity_of_snr(0) /
                                          appearance_.spread().intensity_of_snr(0));
  for (float& intensity : particles_.intensity) intensity *= rescale;
  appearance_ = appearance;
}

void TargetFilters::restored() const {
  require_particles(particles_, bank_.modes.size());
  require_bytes(particles_.size() % count_ == 0, "a target lacks particles");
}

void TargetFilters::add(const Particles& from, std::span<const std::uint32_t> members,
                        std::int64_t frame) {
  const std::size_t first = particles_.size();
  particles_.resize(first + count_);
  drawn_from_.resize(members.size());
  std::ranges::transform(members, drawn_from_.begin(), [&](auto i) { return from.weight[i]; });
  ancestors_.resize(count_);
  draws_.resize(std::max<std::size_t>(draws_.size(), 1));
  device_.run<Resample>({.weights = drawn_from_,
                         .ancestors = ancestors_,
                         .key = target_key(first / count_, frame, Purpose::spawn),
                         .workspace = draws_.data()});
  const std::array moves = moved_particles(from, 0, particles_, first);
  for (std::size_t i = 0; i < count_; ++i) {
    const std::uint32_t source = members[ancestors_[i]];
    for (const MovedArray& array : moves) array.move(source, i);
  }
}

void TargetFilters::add(const Cue& cue, const StepTime& at, double speed_max) {
  const std::size_t first = particles_.size();
  particles_.resize(first + count_);
  const RandomKey key = target_key(first / count_, at.frame, Purpose::cue);
  draw_cued({bank_, appearance_, speed_max, key}, cue, at, particles_, first, count_);
  std::fill_n(particles_.label.begin() + static_cast<std::ptrdiff_t>(first), count_, 0U);
}

void TargetFilters::add(const TargetFilters& other, std::size_t t) {
  const std::size_t first = particles_.size();
  particles_.resize(first + count_);
  for (const MovedArray& array : moved_particles(other.particles_, t * count_, particles_, first)) {
    std::memcpy(array.destination, array.source, 4 * count_);
  }
}

void TargetFilters::remove(std::size_t t) {
  particles_.for_each_array([&](auto& a) {
    const auto first = a.begin() + static_cast<std::ptrdiff_t>(t * count_);
    std::copy(first + static_cast<std::ptrdiff_t>(count_), a.end(), first);
  });
  particles_.resize(particles_.size() - count_);
}

RandomKey TargetFilters::target_key(std::size_t t, std::int64_t frame, Purpose purpose) const {
  return random_key(seed_ ^ (static_cast<std::uint64_t>(t) << 32), index_of(frame), purpose);
}

void TargetFilters::reverse_velocities() {
  for (auto* velocity : {&particles_.vx, &particles_.vy}) {
    for (float& v : *velocity) v = -v;
  }
}

void TargetFilters::predict(std::int64_t frame, double step) {
  move_particles({bank_, appearance_, device_, seed_}, frame, step, particles_);
}

std::span<const TargetUpdate> TargetFilters::update(const Frame& z, std::int64_t frame) {
  auto& p = particles_;
  log_ratio_.resize(p.size());
  weigh_particles({bank_, appearance_, device_, seed_}, z, frame, p, log_ratio_);
  if (indices_.size() < p.size()) {
    indices_.resize(p.size());
    std::iota(indices_.begin(), indices_.end(), 0u);
  }
  updates_.resize(size());
  device_.workers().for_tiles(size(), [&](std::size_t t) { weigh(t); });
  return updates_;
}

void TargetFilters::weigh(std::size_t t) {
  const std::size_t first = t * count_;
  double sum = 0;
  for (std::size_t i = first; i < first + count_; ++i) {
    const float r = log_ratio_[i];
    particles_.weight[i] = r >= -kMaxLogRatio ? math::exp(bounded_log_ratio(r)) : 0.0f;
    sum += particles_.weight[i];
  }
  updates_[t] = {sum / static_cast<double>(count_), {}};
  if (sum <= 0) return;
  updates_[t].estimate =
      describe_cluster(particles_, std::span(indices_).subspan(first, count_), particles_.weight);
  updates_[t].estimate.mass = 1;
}

void TargetFilters::resample(std::int64_t frame) {
  moved_.resize(particles_.size());
  ancestors_.resize(particles_.size());
  draws_.resize(std::max(draws_.size(), size()));
  device_.workers().for_tiles(size(), [&](std::size_t t) { redraw(t, frame); });
  std::swap(particles_, moved_);
}

void TargetFilters::redraw(std::size_t t, std::int64_t frame) {
  const std::size_t first = t * count_;
  const std::array moves = moved_particles(particles_, first, moved_, first);
  device_.run<Resample>({.weights = std::span(particles_.weight).subspan(first, count_),
                         .ancestors = std::span(ancestors_).subspan(first, count_),
                         .key = target_key(t, frame, Purpose::resample),
                         .moved = moves,
                         .workspace = &draws_[t]});
}

}  // namespace glint
