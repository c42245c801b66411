// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/baselines/opencv.hpp"

#include <stdexcept>

#ifdef GLINT_WITH_OPENCV
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace glint::bench {

struct OpenCvPixelLikelihood::State {
  cv::Mat frame, taps, correlation, map, mask;
  std::vector<cv::Point> hits;
  double gain = 1, shift = 0, threshold = 0;
};

bool OpenCvPixelLikelihood::available() { return true; }

OpenCvPixelLikelihood::OpenCvPixelLikelihood(const PixelLikelihood::Args& args)
    : state_(std::make_shared<State>()) {
  const auto z = std::get<ImageView<const float>>(args.frame);
  const auto weights = args.spread.centred_weights();
  State& s = *state_;
  s.frame = cv::Mat(z.height, z.width, CV_32F, const_cast<float*>(z.data),
                    static_cast<std::size_t>(z.pitch) * sizeof(float));
  s.taps.create(args.spread.width(), 1, CV_32F);
  double squares = 0;
  for (int k = 0; k < args.spread.width(); ++k) {
    const double w = weights[static_cast<std::size_t>(k)];
    s.taps.at<float>(k) = static_cast<float>(w);
    squares += w * w;
  }
  s.gain = args.intensity;
  s.shift = -0.5 * args.intensity * args.intensity * squares * squares;
  s.threshold = args.threshold;
}

void OpenCvPixelLikelihood::correlate() const {
  State& s = *state_;
  cv::sepFilter2D(s.frame, s.correlation, CV_32F, s.taps, s.taps, {-1, -1}, 0, cv::BORDER_CONSTANT);
}

void OpenCvPixelLikelihood::run() const {
  State& s = *state_;
  correlate();
  s.correlation.convertTo(s.map, CV_32F, s.gain, s.shift);
  cv::compare(s.map, s.threshold, s.mask, cv::CMP_GT);
  cv::findNonZero(s.mask, s.hits);
}

}  // namespace glint::bench

#else

namespace glint::bench {

struct OpenCvPixelLikelihood::State {};

bool OpenCvPixelLikelihood::available() { return false; }
OpenCvPixelLikelihood::OpenCvPixelLikelihood(const PixelLikelihood::Args&) {
  throw std::logic_error("built without OpenCV");
}
void OpenCvPixelLikelihood::correlate() const {}
void OpenCvPixelLikelihood::run() const {}

}  // namespace glint::bench

#endif
