// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "glint/engine/config.hpp"

namespace glint {

/// What cells show: whitened pixels, the frame as delivered (RPIM), or RPIM of whitened pixels.
enum class CellIntensity { whitened, rpim, rpim_normalised };
/// Whether I_Th is taken off the pixels above it, m2 of P-HPMHT table 3, or not, m1.
enum class CellThreshold { subtract, keep };

/// Settings of `h-pmht`. The unit of time is the frame interval, whatever the frame rate.
struct HPmhtConfig {
  // What the cells show.
  CellIntensity intensity = CellIntensity::whitened;
  double noise_threshold = 1;  ///< [sigma]
  CellThreshold threshold = CellThreshold::subtract;
  double threshold_scale = 1;  ///< multiple of I_Th, P-HPMHT (23)
  // What a target looks like.
  double psf_sigma = 1.0;                    ///< [px]
  double snr = 12;                           ///< [dB]
  bool estimate_extent = false;              ///< learn R, P-HPMHT (18)
  double extent = 0;                         ///< [px^2]; 0 = auto, psf_sigma^2 + 0.25
  double extent_low = 1, extent_high = 400;  ///< limits of what is learnt [px^2]
  // How it moves.
  double process_noise = 0.2;      ///< Q, power spectral density of the acceleration [px^2/frame^3]
  bool estimate_process = false;   ///< learn Q, P-HPMHT (19), within 0.1 to 10 times that
  double position_variance = 1;    ///< [px^2]
  double velocity_variance = 0.5;  ///< [px^2/frame^2]
  double speed_max = 4;            ///< [px/frame]
  /// Motion and prior count as often as the shots of this many cells; at most all of the frame's,
  /// which is the paper's reading and makes one target the stiffer the larger its frame. [px^2]
  double sensor_area = 20;
  // Expectation maximisation.
  int batch = 6;       ///< scans
  int iterations = 3;  ///< at most, a scan
  // How tracks come and go.
  bool initiate = true;
  double candidate_ratio = -0.5;
  int candidates_max = 200;  ///< a frame
  double separation = 4;     ///< [px]
  double duplicate = 3;      ///< [px]
  double confirm_count = 0;  ///< 0 = auto, see least_confirm_count()
  int confirm_frames = 5;
  double halt_count = 1.5;
  int halt_frames = 3;
};
void describe(FieldList& f, HPmhtConfig& c);
/// Mean intensity of a confirmed track. By itself 3.3; of whitened pixels .117 more for each dB
/// that `snr` is below 12, at most 4: the dimmer candidates may be, the more noise is among them,
/// and the more they explain by chance.
double least_confirm_count(const HPmhtConfig& config);

}  // namespace glint
