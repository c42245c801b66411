// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string_view>
#include <vector>

#include "glint/kernels/core/frame.hpp"
#include "glint/kernels/core/trial.hpp"

namespace glint {

/// Noise that the background's own structure causes wherever it moves or is misjudged: a share of
/// the morphological gradient (maximum minus minimum of 3x3), dilated by 5x5. NaN pixels are left
/// out.
struct BackgroundStructure {
  static constexpr std::string_view name = "background_structure";
  static constexpr Tolerance tolerance{0, 1e-6};
  struct Args {
    FrameView background;
    ImageView<float> structure;  ///< [grey levels]; not the background itself
    float share = 0.5F;
  };
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
};

struct Spread {
  double median = 0;
  double sigma = 0;  ///< 1.4826 median |r - median r|
};

/// Median and robust standard deviation of a frame, or of its difference to a background. Taken
/// from the pixels (i step, j step), with the smallest odd step that gives at most kSamples. NaN
/// pixels are left out; 0 without any pixel.
struct RobustSpread {
  static constexpr std::string_view name = "robust_spread";
  static constexpr Tolerance tolerance{1e-4, 1e-5};
  static constexpr int kSamples = 16384;
  struct Args {
    FrameView image;
    FrameView background;  ///< of the image's size, or empty for none
    std::vector<float>* workspace = nullptr;
    Spread* spread = nullptr;
  };
  static int step(int width, int height);
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
};

enum class Polarity {
  bright,
  dark,
  both  ///< |z| less its mean in noise, sqrt(2 / pi): targets of either sign come out positive
};

/// z = polarity (I - background) / S, clipped. S is the largest of the frame's sigma, the RMS of
/// the residual, itself clipped, in a ring around the pixel (a box of 2 outer + 1 pixels less one
/// of 2 inner + 1, cut at the border), and the background's structure. Pixels that are NaN in the
/// image or the background are masked: z = 0, and left out of the rings.
struct Whiten {
  static constexpr std::string_view name = "whiten";
  static constexpr Tolerance tolerance{2e-4, 2e-4};
  static constexpr int kMaxRing = 31;
  struct Args {
    FrameView image, background;
    FrameView structure;   ///< empty for none
    double sigma = 1;      ///< > 0 [grey levels]
    int ring_outer = 0;    ///< half width [px], at most kMaxRing; 0 for no ring
    int ring_inner = 0;    ///< half width [px], < ring_outer
    double ring_clip = 0;  ///< needed with a ring [sigma]
    Polarity polarity = Polarity::bright;
    double clip_low = 0, clip_high = 0;  ///< needed
    ImageView<float> whitened;
    int noise_step = 1;      ///< S is kept at the pixels (i step, j step); NaN where masked
    ImageView<float> noise;  ///< empty, or ceil(width / step) x ceil(height / step)
  };
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
};

}  // namespace glint
