// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <utility>

#include "glint/kernels/add_noise/add_noise.hpp"

namespace glint {
namespace {

class AddNoiseTrial : public Trial {
 public:
  AddNoiseTrial(int width, int height) : image_(width, height) {}
  std::string description() const override {
    return std::to_string(image_.width()) + "x" + std::to_string(image_.height());
  }
  void run(const Device& device) override {
    const ImageView<float> view = image_.view();
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) view(x, y) = static_cast<float>(100 + x - y);
    }
    device.run<AddNoise>({view, 5.5f, random_key(7, 3, Purpose::added_noise)});
  }
  std::vector<Output> outputs() const override {
    Output out{"image", AddNoise::tolerance, {}};
    for (int y = 0; y < image_.height(); ++y) {
      const float* row = image_.view().row(y);
      out.values.insert(out.values.end(), row, row + image_.width());
    }
    return {out};
  }

 private:
  Image<float> image_;
};

}  // namespace

std::vector<std::unique_ptr<Trial>> AddNoise::trials() {
  std::vector<std::unique_ptr<Trial>> all;
  for (const auto& [w, h] :
       {std::pair{0, 0}, {1, 1}, {3, 5}, {255, 3}, {257, 63}, {256, 64}, {101, 65}, {320, 256}}) {
    all.push_back(std::make_unique<AddNoiseTrial>(w, h));
  }
  return all;
}

}  // namespace glint
