// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>

#include "glint/kernels/core/device.hpp"
#include "glint/kernels/core/random.hpp"
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"

namespace glint {
namespace {

struct Problem {
  int width, height;
  double sigma = 0.7;
  bool uint16 = false;
  bool map = true;
  double hits = 0.03;  ///< share of the pixels that hit; 0: no list
  float offset = 0;    ///< of a float frame
};

/// A frame of unit noise with a target at every 23rd pixel or so, in a buffer without margin: what
/// lies beside it is not the kernel's to read.
class PixelTrial : public Trial {
 public:
  explicit PixelTrial(const Problem& problem)
      : problem_(problem), map_(problem.width, problem.height) {
    args_.spread = PointSpread::of(problem.sigma);
    args_.intensity = 8;
    fill(problem);
    if (problem.hits > 0) args_.threshold = threshold_between(problem.hits);
    if (problem.hits > 0) args_.hits = &hits_;
    args_.map = problem.map ? map_.view() : ImageView<float>{};
  }

  std::string description() const override {
    const int window = args_.spread.width();
    return std::to_string(problem_.width) + "x" + std::to_string(problem_.height) +
           (problem_.uint16 ? " u16 " : " float ") + std::to_string(window) + "x" +
           std::to_string(window) + (problem_.map ? " map" : "") +
           (problem_.hits > 0.1 ? " many hits"
            : problem_.hits > 0 ? " hits"
                                : "");
  }
  void run(const Device& device) override { device.run<PixelLikelihood>(args_); }
  std::vector<Output> outputs() const override {
    std::vector<Output> out{{"map", PixelLikelihood::tolerance, {}},
                            {"hit x", {}, {}},
                            {"hit y", {}, {}},
                            {"hit value", PixelLikelihood::tolerance, {}}};
    for (int y = 0; y < args_.map.height; ++y) {
      for (int x = 0; x < args_.map.width; ++x) out[0].values.push_back(args_.map(x, y));
    }
    for (const Hit& hit : hits_) {
      out[1].values.push_back(hit.x);
      out[2].values.push_back(hit.y);
      out[3].values.push_back(hit.value);
    }
    return out;
  }

 private:
  void fill(const Problem& p) {
    const auto n = static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height);
    args_.offset = p.uint16 ? 1000.5f : p.offset;
    args_.scale = p.uint16 ? 0.05f : 1;
    for (std::size_t i = 0; i < n; ++i) {
      const auto item = static_cast<std::uint32_t>(i);
      const float noise = random_normals(random_key(1, 0, Purpose::trial), item).n[0];
      const float z = std::clamp(noise + (item % 23 == 5 ? 4.0f : 0.0f), -8.0f, 8.0f);
      const float pixel = z / args_.scale + args_.offset;
      if (p.uint16) {
        words_.push_back(static_cast<std::uint16_t>(pixel));
      } else {
        floats_.push_back(pixel);
      }
    }
    if (p.uint16) {
      args_.frame = ImageView<const std::uint16_t>{words_.data(), p.width, p.height, p.width};
    } else {
      args_.frame = ImageView<const float>{floats_.data(), p.width, p.height, p.width};
    }
  }

  /// Middle of the widest gap between the reference's values near the given share, so that no
  /// rounding inside the tolerance moves a pixel across.
  float threshold_between(double share) {
    args_.map = map_.view();
    PixelLikelihood::serial(args_);
    std::vector<float> values;
    for (int y = 0; y < map_.height(); ++y) {
      values.insert(values.end(), map_.view().row(y), map_.view().row(y) + map_.width());
    }
    std::sort(values.begin(), values.end(), std::greater<>());
    const auto n = values.size();
    if (n < 2) return -100;
    const auto at = static_cast<std::size_t>(share * static_cast<double>(n));
    std::size_t best = std::min(at, n - 2);
    for (std::size_t i = best; i < std::min(at + n / 10 + 1, n - 1); ++i) {
      if (values[i] - values[i + 1] > values[best] - values[best + 1]) best = i;
    }
    return (values[best] + values[best + 1]) / 2;
  }

  Problem problem_;
  Image<float> map_;
  std::vector<float> floats_;
  std::vector<std::uint16_t> words_;
  std::vector<Hit> hits_;
  PixelLikelihood::Args args_;
};

}  // namespace

std::vector<std::unique_ptr<Trial>> PixelLikelihood::trials() {
  const Problem problems[] = {
      {0, 0},
      {0, 5},
      {1, 1},
      {3, 2},
      {3, 2, 0.7, true},
      {15, 63},
      {16, 64, 0.6},
      {17, 65, 1.0, true},
      {31, 67},
      {32, 66, 0.7, true},
      {33, 129, 1.0},
      {97, 20, 1.7},        // 11x11
      {97, 20, 1.7, true},  //
      {40, 40, 2.5},        // 15x15
      {5, 40, 2.5, true},   // narrower than the window
      {50, 30, 0.3},        // 1x1
      {641, 67},
      {641, 67, 1.0, true},
      {640, 64, 0.6, false, true, 0},
      {301, 70, 1.0, false, true, 0},
      {301, 70, 0.7, true, true, 0},
      {301, 70, 0.7, false, false},
      {301, 70, 1.0, true, false},
      {301, 131, 0.7, false, true, 0.4},
      {301, 131, 0.6, true, false, 0.9},
      {61, 70, 0.7, false, true, 0.03, 100},
      {641, 131, 1.0},  // more than small buffers of a device hold
      {641, 131, 1.7, true},
  };
  std::vector<std::unique_ptr<Trial>> all;
  for (const Problem& problem : problems) all.push_back(std::make_unique<PixelTrial>(problem));
  return all;
}

}  // namespace glint
