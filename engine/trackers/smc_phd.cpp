// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/smc_phd.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "glint/engine/filters/kmeans.hpp"
#include "glint/engine/models/point_spread_fit.hpp"
#include "glint/engine/text.hpp"
#include "glint/kernels/particle_likelihood/particle_likelihood.hpp"
#include "glint/kernels/propagate/propagate.hpp"
#include "glint/kernels/resample/resample.hpp"

namespace glint {
namespace {

BirthProposal proposal_of(const std::string& name) {
  if (name == "uniform") return BirthProposal::uniform;
  return name == "matched-filter" ? BirthProposal::matched_filter : BirthProposal::two_frame;
}

std::uint64_t index_of(std::int64_t frame) { return static_cast<std::uint64_t>(frame); }

}  // namespace

SmcPhd::SmcPhd(const SmcPhdConfig& config, const Device& device, std::uint64_t seed)
    : config_(config),
      device_(device),
      seed_(seed),
      bank_(motion_bank(config.motion, config.process_noise,
                        config.turn_rate * std::numbers::pi / 180)),
      identities_(config.identity) {
  if (config.snr_low > config.snr_high) {
    throw ConfigError("snr_low must not exceed snr_high: lower snr_low or raise snr_high");
  }
}

void SmcPhd::set_up(double psf_sigma) {
  spread_ = PointSpread::of(psf_sigma);
  intensity_low_ = static_cast<float>(spread_.intensity_of_snr(config_.snr_low));
  intensity_high_ = static_cast<float>(spread_.intensity_of_snr(config_.snr_high));
  births_ = std::make_unique<Births>(
      BirthConfig{proposal_of(config_.birth), config_.birth_particles, config_.birth_mass,
                  config_.birth_threshold, config_.speed_max, intensity_low_, intensity_high_,
                  config_.jitter},
      bank_, spread_, device_, seed_);
}

// Until some target is bright enough to show its shape, the default shape serves. The first frames
// are no guide: their background is not known yet, and its structure passes for targets.
void SmcPhd::fit(const Scan& scan) {
  constexpr int kSettling = 15;
  const auto sigma =
      ++seen_ < kSettling ? std::nullopt : fit_point_spread(scan.whitened.view(), scan.raw.view());
  if (sigma) {
    fitted_ = true;
    particles_.resize(0);  // their intensities were for another shape
    set_up(*sigma);
  } else if (!births_) {
    set_up(SmcPhdConfig{}.psf_sigma);
  }
}

void SmcPhd::step(const Scan& scan, TrackLog& log) {
  if (scan.whitened.view().empty()) return;
  if (last_frame_ < 0) log.set_mode_names(bank_.names);
  if (config_.psf_sigma > 0 && !births_) set_up(config_.psf_sigma);
  if (config_.psf_sigma <= 0 && !fitted_) fit(scan);
  const double step = last_frame_ < 0 ? 1 : static_cast<double>(scan.frame - last_frame_);
  predict(scan.frame, step);
  give_birth(scan, step);
  update(scan);
  report(scan, step, log);
  resample(scan.frame);
  last_frame_ = scan.frame, last_time_ = scan.time;
}

void SmcPhd::predict(std::int64_t frame, double step) {
  const double walk = config_.intensity_walk * 2 * std::numbers::pi * spread_.sigma * spread_.sigma;
  auto& p = particles_;
  device_.run<Propagate>({.x = p.x,
                          .y = p.y,
                          .vx = p.vx,
                          .vy = p.vy,
                          .intensity = p.intensity,
                          .ax = p.ax,
                          .ay = p.ay,
                          .mode = p.mode,
                          .modes = bank_.modes,
                          .switching = bank_.switching,
                          .step = static_cast<float>(step),
                          .intensity_noise = static_cast<float>(walk * walk),
                          .intensity_low = intensity_low_,
                          .intensity_high = intensity_high_,
                          .seed = seed_,
                          .frame = static_cast<std::uint32_t>(frame)});
  // P-PHD (11): survivors keep w_{k-1}, times the probability of survival.
  const auto survival = static_cast<float>(config_.survival);
  for (auto& w : p.weight) w *= survival;
}

void SmcPhd::give_birth(const Scan& scan, double step) {
  survivors_ = particles_.size();
  const std::size_t all = survivors_ + static_cast<std::size_t>(config_.birth_particles);
  particles_.resize(all);
  for (auto* zero : {&particles_.ax, &particles_.ay}) {
    std::fill(zero->begin() + static_cast<std::ptrdiff_t>(survivors_), zero->end(), 0.0f);
  }
  std::fill(particles_.label.begin() + static_cast<std::ptrdiff_t>(survivors_),
            particles_.label.end(), 0u);
  const std::size_t born = births_->draw(scan.whitened, scan.frame, step, cells_, config_.clutter,
                                         particles_, survivors_);
  particles_.resize(survivors_ + born);
}

void SmcPhd::update(const Scan& scan) {
  auto& p = particles_;
  log_ratio_.resize(p.size());
  updated_.resize(p.size());
  device_.run<ParticleLikelihood>(
      {.frame = scan.whitened.view(),
       .spread = spread_,
       .x = p.x,
       .y = p.y,
       .intensity = p.intensity,
       .log_ratio = log_ratio_,
       .jitter = static_cast<float>(config_.jitter),
       .key = random_key(seed_, index_of(scan.frame), Purpose::jitter)});
  device_.run<CellWeights>({.width = scan.whitened.width(),
                            .height = scan.whitened.height(),
                            .half_width = spread_.half_width,
                            .psi = config_.psi == "cell" ? Psi::cell : Psi::window,
                            .clutter = static_cast<float>(config_.clutter),
                            .x = p.x,
                            .y = p.y,
                            .predicted = p.weight,
                            .log_ratio = log_ratio_,
                            .updated = updated_,
                            .workspace = &cells_});
  std::swap(p.weight, updated_);
  expected_ = total_mass(cells_.runs);  // P-PHD (19)
}

void SmcPhd::report(const Scan& scan, double step, TrackLog& log) {
  const double seconds = last_frame_ < 0 ? 1 : scan.time - last_time_;
  const double velocity_scale = seconds > 0 ? step / seconds : 1;
  const std::size_t modes = bank_.modes.size();
  if (config_.states == "kmeans") {
    const auto states = kmeans_states(
        particles_, random_key(seed_, index_of(scan.frame), Purpose::kmeans), kmeans_members_);
    identities_.assign(states, kmeans_members_, particles_, scan.frame, scan.time, step,
                       velocity_scale, modes, log);
    return;
  }
  const double radius =
      config_.cluster_radius > 0 ? config_.cluster_radius : spread_.half_width + 0.5;
  const auto peaks =
      peaks_.find(particles_, cells_.runs, scan.whitened.width(), scan.whitened.height(),
                  spread_.half_width, {config_.existence, radius});
  identities_.assign(peaks, peaks_.members(), particles_, scan.frame, scan.time, step,
                     velocity_scale, modes, log);
}

void SmcPhd::resample(std::int64_t frame) {
  auto& p = particles_;
  const double targets = std::max(1.0, std::ceil(expected_));
  const double wanted =
      std::min({targets * config_.particles_per_target, static_cast<double>(config_.particles_max),
                static_cast<double>(p.size())});
  const std::size_t kept = expected_ > 0 ? static_cast<std::size_t>(wanted) : 0;
  moved_.resize(kept);
  ancestors_.resize(kept);
  if (kept > 0) {
    const std::array moves{MovedArray{p.x.data(), moved_.x.data()},
                           MovedArray{p.y.data(), moved_.y.data()},
                           MovedArray{p.vx.data(), moved_.vx.data()},
                           MovedArray{p.vy.data(), moved_.vy.data()},
                           MovedArray{p.ax.data(), moved_.ax.data()},
                           MovedArray{p.ay.data(), moved_.ay.data()},
                           MovedArray{p.intensity.data(), moved_.intensity.data()},
                           MovedArray{p.mode.data(), moved_.mode.data()},
                           MovedArray{p.label.data(), moved_.label.data()}};
    device_.run<Resample>(
        {.weights = p.weight,
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

std::vector<std::string> SmcPhd::notes() const {
  const std::string how = config_.psf_sigma > 0 ? "given"
                          : fitted_             ? "fitted to the brightest local maxima"
                                    : "the default: nothing was bright enough to fit it";
  return {"psf_sigma = " + number_text(spread_.sigma) + " px (" + how + ")"};
}

}  // namespace glint
