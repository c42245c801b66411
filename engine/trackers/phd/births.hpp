// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "glint/engine/config.hpp"
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

/// Where targets come from.
struct BirthConfig {
  BirthProposal birth = BirthProposal::two_frame;
  int birth_particles = 4000;    ///< new-born particles a frame, J
  int birth_growth = 1;          ///< J is up to so many times as large in large frames
  double birth_mass = 0.05;      ///< expected new-born targets a frame, gamma
  double birth_threshold = 1.5;  ///< of the uniform proposal [noise sigmas]
};
void describe(FieldList& f, BirthConfig& c);

/// What the births of one frame are drawn from.
struct BirthScan {
  const Frame& z;
  std::int64_t frame;
  double step;  ///< since the frame before [frame]
  /// Cells of the filter's update at the frame before, of the same size.
  const CellWorkspace& previous;
  double clutter;         ///< lambda of P-PHD (14), in likelihood-ratio units
  const PixelMask& mask;  ///< nothing is born there
};

/// A frame and its birth scores, needed until the next one.
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

/// Draws new-born particles and their weights: P-PHD (28)-(30), or an importance density in place
/// of (28) and (29). Positions are those at the present frame [px], velocities in [px/frame].
class Births {
 public:
  Births(const BirthConfig& config, const MotionConfig& motion, const Device& device,
         std::uint64_t seed);
  /// Sets what new-born targets look like; forgets the frame before.
  void set_appearance(const TargetAppearance& appearance);

  /// Looks at the scan; returns how many particles are born: none if there is nothing to draw from
  /// (no frame before, no cell above the threshold).
  std::size_t prepare(const BirthScan& scan);
  /// Writes the particles of the scan that prepare() got to `particles` from index `at` on (already
  /// resized), on the host and on the device if they are resident.
  void draw(const BirthScan& scan, Particles& particles, std::size_t at);

  // The present frame is the frame before of the next prepare().
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.spread_.sigma, s.intensity_low_, s.intensity_high_, s.jitter_, s.now_);
  }
  void restored() { spread_ = PointSpread::of(spread_.sigma); }

 private:
  void score(const Frame& z, const PixelMask& mask);
  std::size_t number_for(const Frame& z) const;
  void draw_uniform(const BirthScan& scan, Particles& p, std::size_t at);
  void draw_matched(const BirthScan& scan, Particles& p, std::size_t at);
  void draw_two_frame(const BirthScan& scan, Particles& p, std::size_t at);
  void send(Particles& particles, std::size_t at) const;
  void draw_cells(const BirthFrame& frame, RandomKey key);
  void pick_next_cells(RandomKey key, double step);
  std::uint32_t draw_mode(std::uint32_t word) const;
  float draw_intensity(std::uint32_t word) const;

  BirthConfig config_;
  BirthProposal proposal_;
  double speed_max_;               // [px/frame]
  std::vector<float> birth_mode_;  // probability of each motion model
  PointSpread spread_;
  float intensity_low_ = 1, intensity_high_ = 1, jitter_ = 0;
  Device device_;
  std::uint64_t seed_;
  BirthFrame now_, before_;
  std::size_t count_ = 0;  // of particles that draw() writes
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
