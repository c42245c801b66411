// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/births.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "glint/engine/state/bytes.hpp"
#include "glint/kernels/birth_scores/birth_scores.hpp"
#include "glint/kernels/core/cells.hpp"
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"
#include "glint/kernels/resample/resample.hpp"

namespace glint {
namespace {

/// Pixels above the threshold, as flat indices; none in the mask.
void cells_above(FrameView z, const PixelMask& mask, double threshold,
                 std::vector<std::uint32_t>& cells) {
  cells.clear();
  for (int y = 0; y < z.height; ++y) {
    for (int x = 0; x < z.width; ++x) {
      if (!(z(x, y) >= threshold)) continue;
      if (!mask.covers(static_cast<float>(x), static_cast<float>(y))) {
        cells.push_back(cell_at(x, y, z.width));
      }
    }
  }
}

}  // namespace

Births::Births(const BirthConfig& config, const MotionConfig& motion, const Device& device,
               std::uint64_t seed)
    : config_(config),
      proposal_(config.birth),
      speed_max_(motion.speed_max),
      birth_mode_(motion.bank().birth),
      device_(device),
      seed_(seed),
      now_(device),
      before_(device) {
  cells_.reserve(static_cast<std::size_t>(config.birth_particles));
}

void Births::set_appearance(const TargetAppearance& appearance) {
  spread_ = appearance.spread();
  intensity_low_ = appearance.intensity_low(), intensity_high_ = appearance.intensity_high();
  jitter_ = appearance.jitter();
  for (BirthFrame* frame : {&now_, &before_}) frame->whitened = {}, frame->total = 0;
}

void BirthFrame::restored() const {
  const auto pixels =
      static_cast<std::size_t>(whitened.width()) * static_cast<std::size_t>(whitened.height());
  require_bytes(score.size() == pixels, "birth scores do not fit their frame");
  require_bytes(
      std::ranges::all_of(score.values(), [](float s) { return s >= 0 && std::isfinite(s); }),
      "a birth score is negative or not finite");
}

void Births::score(const Frame& z, const PixelMask& mask) {
  const FrameView view = z.for_kernels();
  std::swap(now_, before_);
  now_.whitened = z;
  now_.score.resize(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height));
  if (map_.width() != view.width || map_.height() != view.height) {
    map_ = ResidentImage<float>(view.width, view.height, device_);
  }
  const std::span<float> scores = now_.score.values();
  row_sums_.resize(static_cast<std::size_t>(view.height));
  const auto intensity = static_cast<float>(std::sqrt(double{intensity_low_} * intensity_high_));
  device_.run<PixelLikelihood>(
      {.frame = view, .spread = spread_, .intensity = intensity, .map = map_.view()});
  double energy = 0;
  for (const double w : spread_.centred_weights()) energy += w * w;
  device_.run<BirthScores>({.map = map_.view(),
                            .intensity = intensity,
                            .energy = static_cast<float>(energy * energy),
                            .intensity_low = intensity_low_,
                            .intensity_high = intensity_high_,
                            .score = {scores.data(), view.width, view.height, view.width},
                            .masked = mask.boxes(),
                            .row_sums = row_sums_});
  now_.total = std::accumulate(row_sums_.begin(), row_sums_.end(), 0.0);
}

/// As large a share of the pixels as birth_particles are of 256x256.
std::size_t Births::number_for(const Frame& z) const {
  constexpr double kPixels = 256 * 256;
  const double pixels = static_cast<double>(z.width()) * z.height();
  const double times =
      std::clamp(std::floor(pixels / kPixels), 1.0, static_cast<double>(config_.birth_growth));
  return static_cast<std::size_t>(
      std::min(config_.birth_particles * times, static_cast<double>(Resample::kMaxCount)));
}

std::size_t Births::prepare(const BirthScan& scan) {
  if (proposal_ == BirthProposal::uniform) {
    cells_above(scan.z.view(), scan.mask, config_.birth_threshold, cells_);
    return count_ = cells_.empty() ? 0 : static_cast<std::size_t>(config_.birth_particles);
  }
  score(scan.z, scan.mask);
  double total = now_.total;
  if (proposal_ == BirthProposal::two_frame) {
    const bool first =
        before_.whitened.width() != scan.z.width() || before_.whitened.height() != scan.z.height();
    total = first || total <= 0 ? 0 : before_.total;
  }
  return count_ = total > 0 ? number_for(scan.z) : 0;
}

void Births::draw(const BirthScan& scan, Particles& particles, std::size_t at) {
  if (count_ == 0) return;
  switch (proposal_) {
    case BirthProposal::uniform:
      return draw_uniform(scan, particles, at);
    case BirthProposal::matched_filter:
      return draw_matched(scan, particles, at);
    case BirthProposal::two_frame:
      return draw_two_frame(scan, particles, at);
  }
}

}  // namespace glint
