// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/background.hpp"

#include <algorithm>

#include "glint/engine/frames/registered_background.hpp"
#include "glint/engine/frames/temporal_background.hpp"

namespace glint {
namespace {

class SpatialBackground : public Background {
 public:
  SpatialBackground(int spacing, const Device& device) : spacing_(spacing), device_(device) {}
  bool estimate(const BackgroundInput& input, ImageView<float> background) override {
    device_.run<SpatialMedian>({input.grey, spacing_, background});
    return true;
  }
  void learn(const BackgroundInput&) override {}
  void save(ByteWriter&) const override {}
  void restore(ByteReader&, int, int) override {}
  std::string description() const override {
    return "background: spatial median of " + std::to_string(4 * spacing_ + 1) + " px";
  }

 private:
  int spacing_;
  Device device_;
};

class NoBackground : public Background {
 public:
  explicit NoBackground(const Device& device) : device_(device) {}
  bool estimate(const BackgroundInput&, ImageView<float> background) override {
    if (!first_) return false;
    first_ = false;
    for (int y = 0; y < background.height; ++y) {
      std::fill_n(background.row(y), background.width, 0.0F);
    }
    device_.send(background);
    return true;
  }
  void learn(const BackgroundInput&) override {}
  void rewrite() override { first_ = true; }
  void save(ByteWriter&) const override {}
  void restore(ByteReader&, int, int) override {}
  std::string description() const override { return "background: none"; }

 private:
  Device device_;
  bool first_ = true;
};

}  // namespace

std::unique_ptr<Background> make_background(const FramesConfig& config, const Device& device) {
  if (config.background == BackgroundKind::temporal)
    return std::make_unique<TemporalBackground>(config, device);
  if (config.background == BackgroundKind::registered) {
    return std::make_unique<RegisteredBackground>(config, device);
  }
  if (config.background == BackgroundKind::none) return std::make_unique<NoBackground>(device);
  const int spacing = std::clamp((config.spatial_window - 1) / 4, 1, SpatialMedian::kMaxSpacing);
  return std::make_unique<SpatialBackground>(spacing, device);
}

}  // namespace glint
