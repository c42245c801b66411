// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <utility>

#include "glint/kernels/birth_scores/birth_scores.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint {
namespace {

class BirthScoresTrial : public Trial {
 public:
  BirthScoresTrial(int width, int height)
      : map_(width, height), score_(width, height), row_sums_(static_cast<std::size_t>(height)) {
    if (height > 40) masked_ = {{0, 0, 5, 3}, {9, 20, width, 40}};
    const RandomKey key = random_key(1, 0, Purpose::trial);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto item = static_cast<std::uint32_t>(y * width + x);
        map_.view()(x, y) = -6 + 8 * random_normals(key, item).n[0];
      }
    }
  }
  std::string description() const override {
    return std::to_string(map_.width()) + "x" + std::to_string(map_.height());
  }
  void run(const Device& device) override {
    device.run<BirthScores>({.map = map_.view(),
                             .intensity = 9.7f,
                             .energy = 0.138f,
                             .intensity_low = 5,
                             .intensity_high = 40,
                             .score = score_.view(),
                             .masked = masked_,
                             .row_sums = row_sums_});
  }
  std::vector<Output> outputs() const override {
    Output out{"score", BirthScores::tolerance, {}};
    for (int y = 0; y < score_.height(); ++y) {
      const float* row = score_.view().row(y);
      out.values.insert(out.values.end(), row, row + score_.width());
    }
    return {out, {"row_sums", BirthScores::tolerance, row_sums_}};
  }

 private:
  Image<float> map_, score_;
  std::vector<Box> masked_;
  std::vector<double> row_sums_;
};

}  // namespace

std::vector<std::unique_ptr<Trial>> BirthScores::trials() {
  std::vector<std::unique_ptr<Trial>> all;
  for (const auto& [w, h] : {std::pair{0, 0}, {1, 1}, {15, 3}, {17, 63}, {64, 64}, {101, 65}}) {
    all.push_back(std::make_unique<BirthScoresTrial>(w, h));
  }
  return all;
}

}  // namespace glint
