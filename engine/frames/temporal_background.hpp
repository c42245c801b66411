// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "glint/engine/frames/background.hpp"
#include "glint/engine/frames/sample_times.hpp"
#include "glint/kernels/core/resident_memory.hpp"

namespace glint {

/// Running median over samples of past frames, for cameras that stand still; a spatial median for
/// the first frame. Samples of 8 or 16 bits are kept as such.
class TemporalBackground : public Background {
 public:
  TemporalBackground(const FramesConfig& config, const Device& device);
  bool estimate(const BackgroundInput& input, ImageView<float> background) override;
  void learn(const BackgroundInput& input) override;
  void rewrite() override { stale_ = true; }
  bool provisional() const override { return provisional_; }
  std::string description() const override;
  void save(ByteWriter& to) const override;
  void restore(ByteReader& from, int width, int height) override;
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.times_, s.now_, s.samples_);
  }

 private:
  template <class T>
  struct Samples {
    std::vector<ResidentImage<T>> images;
    std::vector<ImageView<const T>> views;
    template <class Self>
    static auto fields(Self& s) {
      return std::tie(s.images);
    }
    void restored() {
      for (const ResidentImage<T>& image : images) views.push_back(image.view());
    }
  };
  void start(const BackgroundInput& input);
  template <class T>
  static ImageView<const T> pixels(const RawPixels& raw);
  template <class T>
  void keep(Samples<T>& samples, std::size_t slot, ImageView<const T> image);

  Device device_;
  int spacing_;
  SampleTimes times_;
  std::int64_t now_ = 0;
  bool stale_ = false, provisional_ = true;
  std::variant<Samples<std::uint8_t>, Samples<std::uint16_t>, Samples<float>> samples_;
};

}  // namespace glint
