// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <tuple>
#include <vector>

#include "glint/engine/frames/target_appearance.hpp"
#include "glint/engine/trackers/phd/motion_bank.hpp"
#include "glint/engine/trackers/phd/pixel_mask.hpp"
#include "glint/kernels/cell_weights/cell_weights.hpp"
#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/particles.hpp"
#include "glint/kernels/core/point_spread.hpp"
#include "glint/kernels/core/resident_memory.hpp"
#include "glint/kernels/resample/resample.hpp"

namespace glint {

/// Where new-born particles come from.
enum class BirthProposal {
  uniform,         ///< the 3x3 pixels around each one above a threshold. P-PHD section 5.1
  matched_filter,  ///< cells in proportion to their birth score, importance weights
  two_frame        ///< a pair of cells in two successive frames: position and velocity at once
};

struct BirthConfig {
  BirthProposal proposal = BirthProposal::two_frame;
  int count = 4000;        ///< particles a frame, J
  double mass = 0.05;      ///< expected new-born targets a frame, gamma
  double threshold = 1.5;  ///< of the uniform proposal [noise sigmas]
  double speed_max = 4;    ///< largest speed along each axis [px/frame]
};

/// What births of one frame are drawn from.
struct BirthScan {
  const Frame& z;
  std::int64_t frame;
  double step;  ///< since the frame before [frames]
  /// Cell map of the update of the frame before, of the same size.
  const CellWorkspace& previous;
  double clutter;
  const PixelMask& mask;  ///< nothing is born there
};

/// One frame as births see it, kept until the next.
struct BirthFrame {
  explicit BirthFrame(const Device& device) : score(device) {}
  Frame whitened;
  ResidentArray<float> score;  ///< row by row, without padding
  double total = 0;            ///< sum of the scores

  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.whitened, s.score, s.total);
  }
  void restored() const;
};

/// Draws new-born particles with their weights; their position is the one at the present frame.
class Births {
 public:
  Births(const BirthConfig& config, const MotionBank& bank, const Device& device,
         std::uint64_t seed);
  /// What the new-born look like; forgets the frame before.
  void set_appearance(const TargetAppearance& appearance);

  /// Writes `config.count` particles to `particles` from index `at` on (already resized), on the
  /// host and on the device if they are resident. Returns
  /// how many were written: fewer only if there is nothing to draw from (no frame before, no cell
  /// above the threshold).
  std::size_t draw(const BirthScan& scan, Particles& particles, std::size_t at);

  // The frame at hand is the one before of the next draw().
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.spread_.sigma, s.intensity_low_, s.intensity_high_, s.jitter_, s.now_);
  }
  void restored() { spread_ = PointSpread::of(spread_.sigma); }

 private:
  void look_at(const Frame& z, const PixelMask& mask);
  std::size_t draw_uniform(const BirthScan& scan, Particles& p, std::size_t at);
  std::size_t draw_matched(const BirthScan& scan, Particles& p, std::size_t at);
  std::size_t draw_two_frame(const BirthScan& scan, Particles& p, std::size_t at);
  void send(Particles& particles, std::size_t at) const;
  void draw_cells(const BirthFrame& frame, RandomKey key);
  void pick_next_cells(RandomKey key, double step);
  std::uint32_t draw_mode(std::uint32_t word) const;
  float draw_intensity(std::uint32_t word) const;

  BirthConfig config_;
  MotionBank bank_;
  PointSpread spread_;
  float intensity_low_ = 1, intensity_high_ = 1, jitter_ = 0;
  Device device_;
  std::uint64_t seed_;
  BirthFrame now_, before_;
  ResidentImage<float> map_;
  std::vector<std::uint32_t> cells_, next_cells_;
  AlignedVector<float> cell_score_, uniform_, next_score_;
  std::vector<double> next_total_;
  AlignedVector<float> x_before_, y_before_, log_ratio_, updated_;
  std::vector<double> row_sums_;
  CellWorkspace shares_;
  ResampleWorkspace draws_;
};

}  // namespace glint
