// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "glint/engine/frames/background.hpp"
#include "glint/kernels/core/resident_memory.hpp"

namespace glint {

/// Median over past frames, each registered to the present one by itself, for cameras that move; a
/// spatial median for the first frame. Shifts are never chained, and one that does not pay is not
/// used: chained or ungated registration drifts.
class RegisteredBackground : public Background {
 public:
  RegisteredBackground(const FramesConfig& config, const Device& device);
  bool estimate(const BackgroundInput& input, ImageView<float> background) override;
  void learn(const BackgroundInput& input) override;
  bool provisional() const override { return provisional_; }
  std::string description() const override;
  void save(ByteWriter& to) const override;
  void restore(ByteReader& from, int width, int height) override;
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.next_, s.now_, s.shifted_, s.compared_, s.samples_);
  }

 private:
  /// A frame and its halves, finest first.
  struct Pyramid {
    std::vector<ResidentImage<float>> levels;
    std::vector<FrameView> views;
    void put_to(ByteWriter& to) const;
    void take_from(ByteReader& from);
  };
  void build(FrameView image, Pyramid& pyramid) const;
  FrameView registered(const Pyramid& sample, ResidentImage<float>& moved);

  Device device_;
  int spacing_, max_shift_, stride_;
  double gain_;
  bool provisional_ = true;
  std::size_t slots_, next_ = 0;
  std::int64_t now_ = 0, shifted_ = 0, compared_ = 0;
  Pyramid present_;
  std::vector<Pyramid> samples_;
  std::vector<ResidentImage<float>> moved_;
  std::vector<FrameView> stack_;
};

}  // namespace glint
