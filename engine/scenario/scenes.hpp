// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/engine/scenario/scenario.hpp"

namespace glint {

/// P-PHD section 5.1: one dim target at constant velocity in white noise, alive in the paper's
/// frames 5 to 24; before and after the frames are empty.
struct PhdScene {
  static constexpr std::string_view kName = "phd-5.1";
  double snr = 10;  ///< [dB]
  double jitter = 0.5;
  int frames = 30;
};
void describe(FieldList& list, PhdScene& config);
Scene make_scene(const PhdScene& config);

/// P-PHD section 5.2: three targets that come and go, two of which fly straight, turn for 10 s and
/// fly straight again. The paper does not say how fast they turn.
struct PhdManoeuvreScene {
  static constexpr std::string_view kName = "phd-5.2";
  double snr = 10;  ///< [dB]
  double jitter = 0.5;
  double turn_rate = 15;  ///< [deg/s]
};
void describe(FieldList& list, PhdManoeuvreScene& config);
Scene make_scene(const PhdManoeuvreScene& config);

/// P-PHD section 5.3: a frame every 2 s, two targets from the paper's frame 8 on and a dimmer one
/// from frame 15 on. The paper's paths are from a program of its own; these are arcs of its speeds.
struct PhdArcsScene {
  static constexpr std::string_view kName = "phd-5.3";
  double snr = 13, snr_third = 11;  ///< [dB]
  double jitter = 0.5;
  double turn_rate = 3;  ///< [deg/s]
};
void describe(FieldList& list, PhdArcsScene& config);
Scene make_scene(const PhdArcsScene& config);

/// One target in white noise that keeps its course but for a little noise, in frames 10 to 39 of
/// 50; where it is and flies, each variant draws anew. It stays 3 px inside the frame.
struct DimTargetScene {
  static constexpr std::string_view kName = "dim-target";
  int size = 64;             ///< width and height [px]
  double snr = 6;            ///< [dB]
  double speed = 1.5;        ///< [px/frame]
  double manoeuvre = 0.001;  ///< variance that a frame adds to each velocity [px^2/frame^2]
  int variant = 0;
};
void describe(FieldList& list, DimTargetScene& config);
/// Throws ConfigError if no course fits into the frame.
Scene make_scene(const DimTargetScene& config);

/// Many targets like that, of 6 to 14 dB and .2 to 2 px/frame, in frames 3 to 36 of 40.
struct DimFieldScene {
  static constexpr std::string_view kName = "dim-field";
  int size = 512;  ///< width and height [px]
  int targets = 200;
  double snr_low = 6, snr_high = 14;       ///< [dB]
  double speed_low = 0.2, speed_high = 2;  ///< [px/frame]
  double manoeuvre = 0.002;                ///< [px^2/frame^2]
  int variant = 0;
};
void describe(FieldList& list, DimFieldScene& config);
/// Throws ConfigError if a low end is above its high end or no course fits into the frame.
Scene make_scene(const DimFieldScene& config);

/// An infrared-like clip after P-PMHT section 4: point targets on B-spline paths above a skyline,
/// in grey levels.
struct IrClipScene {
  static constexpr std::string_view kName = "ir-clip";
  int frames = 120;
  double noise = 5;                   ///< [grey levels]
  double snr_low = 8, snr_high = 11;  ///< [dB], spread over the targets
  double speed = 2;                   ///< [px/frame], mean
  double sigma = 1.0;                 ///< of the point spread [px]
};
void describe(FieldList& list, IrClipScene& config);
Scene make_scene(const IrClipScene& config);

/// P-HPMHT section 4: a dark aircraft (jet or helicopter) on a curved path before a cloudy sky, a
/// 200x200 crop in grey levels. The paper's scan is every second frame.
struct AircraftScene {
  static constexpr std::string_view kName = "aircraft";
  int scenario = 1;  ///< row of table 1
  int frames = 41;
  double clutter = 1;
  int variant = 0;
};
void describe(FieldList& list, AircraftScene& config);
Scene make_scene(const AircraftScene& config);

/// P-PMHT section 4: paths over 1024x256 pixels, up to 17 px/frame, before white noise. bs44, bs49
/// and bs50 stand for the paper's clips ir44, ir49 and ir50, whose paths it does not print.
struct PmhtClipScene {
  static constexpr std::string_view kName = "pmht-clip";
  std::string clip = "bs44";
  double snr = 14;  ///< [dB]
  int variant = 0;
};
void describe(FieldList& list, PmhtClipScene& config);
Scene make_scene(const PmhtClipScene& config);

/// White noise and nothing else.
struct NoiseScene {
  static constexpr std::string_view kName = "noise";
  int width = 40, height = 40, frames = 30;
  double noise = 1;
};
void describe(FieldList& list, NoiseScene& config);
Scene make_scene(const NoiseScene& config);

/// Two targets whose straight paths cross half way.
struct CrossingScene {
  static constexpr std::string_view kName = "crossing";
  double snr = 14;  ///< [dB]
  int frames = 40;
};
void describe(FieldList& list, CrossingScene& config);
Scene make_scene(const CrossingScene& config);

}  // namespace glint
