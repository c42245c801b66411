// SPDX-License-Identifier: Apache-2.0
#include <limits>
#include <string>

#include "glint/kernels/core/random.hpp"
#include "glint/kernels/find_points/find_points.hpp"

namespace glint {
namespace {

using Mode = FindPoints::Mode;

struct Problem {
  int width, height;
  Mode mode;
  float threshold;
  int radius = 1;
  bool coarse = false;  ///< whole numbers, so that many neighbours tie, and some masked pixels
};

Image<float> noise_map(const Problem& p) {
  Image<float> map(p.width, p.height);
  const RandomKey key = random_key(1, 0, Purpose::trial);
  for (int y = 0; y < p.height; ++y) {
    for (int x = 0; x < p.width; ++x) {
      const auto item = static_cast<std::uint32_t>(y * p.width + x);
      const float noise = random_normals(key, item).n[0];
      const bool masked = p.coarse && item % 31 == 7;
      const float coarse = static_cast<float>(static_cast<int>(noise + 8)) - 8;
      map.view()(x, y) = masked     ? std::numeric_limits<float>::quiet_NaN()
                         : p.coarse ? coarse
                                    : noise;
    }
  }
  return map;
}

class FindPointsTrial : public Trial {
 public:
  explicit FindPointsTrial(const Problem& problem) : problem_(problem), map_(noise_map(problem)) {}

  std::string description() const override {
    return std::to_string(problem_.width) + "x" + std::to_string(problem_.height) +
           (problem_.mode == Mode::unit_5x5
                ? " units"
                : " maxima, radius " + std::to_string(problem_.radius)) +
           ", threshold " + std::to_string(problem_.threshold).substr(0, 4) +
           (problem_.coarse ? ", ties and masked pixels" : "");
  }
  void run(const Device& device) override {
    device.run<FindPoints>({.map = map_.view(),
                            .mode = problem_.mode,
                            .threshold = problem_.threshold,
                            .radius = problem_.radius,
                            .points = &points_,
                            .workspace = &workspace_});
  }
  std::vector<Output> outputs() const override {
    std::vector<Output> out{{"count", {}, {static_cast<double>(points_.size())}},
                            {"x", FindPoints::tolerance, {}},
                            {"y", FindPoints::tolerance, {}},
                            {"amplitude", FindPoints::tolerance, {}}};
    for (const Point& p : points_) {
      out[1].values.push_back(p.x);
      out[2].values.push_back(p.y);
      out[3].values.push_back(p.amplitude);
    }
    return out;
  }

 private:
  Problem problem_;
  Image<float> map_;
  std::vector<Point> points_;
  PointWorkspace workspace_;
};

}  // namespace

std::vector<std::unique_ptr<Trial>> FindPoints::trials() {
  constexpr Mode kMaxima = Mode::local_maximum, kUnits = Mode::unit_5x5;
  std::vector<std::unique_ptr<Trial>> list;
  const auto add = [&](const Problem& p) { list.push_back(std::make_unique<FindPointsTrial>(p)); };
  // A tile of 641 columns is 205 rows; a row of 26215 columns makes it 5.
  for (const auto& [width, height] : {std::pair{0, 0},
                                      {1, 1},
                                      {1, 9},
                                      {9, 1},
                                      {5, 5},
                                      {15, 7},
                                      {16, 16},
                                      {63, 31},
                                      {65, 6},
                                      {81, 33},
                                      {641, 204},
                                      {641, 205},
                                      {641, 206},
                                      {1023, 411},
                                      {26215, 11}}) {
    add({width, height, kMaxima, 2.5f});
    add({width, height, kUnits, 0.2f});
    add({width, height, kMaxima, 0, 1, true});
    add({width, height, kUnits, 0.1f, 1, true});
  }
  for (const int radius : {0, 2, 7}) add({333, 97, kMaxima, 1.0f, radius});
  add({333, 97, kMaxima, -std::numeric_limits<float>::infinity(), 3, true});
  add({333, 97, kUnits, -std::numeric_limits<float>::infinity(), 1, true});
  return list;
}

}  // namespace glint
