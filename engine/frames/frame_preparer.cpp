// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/frames/frame_preparer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <variant>

#include "glint/engine/frames/background.hpp"
#include "glint/engine/frames/frame_pool.hpp"
#include "glint/engine/state/fields.hpp"
#include "glint/kernels/core/cells.hpp"
#include "glint/kernels/core/resident_memory.hpp"

namespace glint {
namespace {

constexpr int kNoiseSamples = 4096;  // of the noise map, for its median

/// Least sigma in grey levels: compressed video freezes blocks, sensors repeat values, and a noise
/// of 0 would make a target of every later change. Key frames of a codec leave residues of 3
/// levels.
double automatic_floor(const RawPixels& raw, bool reciprocal, FrameView grey) {
  if (reciprocal) return 0.05;
  if (std::holds_alternative<const std::uint8_t*>(raw.data)) return 4;
  if (std::holds_alternative<const std::uint16_t*>(raw.data)) return 0.5;
  float most = 0;
  for (int y = 0; y < grey.height; ++y) {
    for (int x = 0; x < grey.width; ++x) most = std::max(most, std::abs(grey(x, y)));
  }
  return most > 0 ? 1e-6 * most : 1e-6;
}

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

/// As checked() does, and within what kernels take.
RawPixels fitting(const RawPixels& given) {
  const RawPixels raw = checked(given);
  if (raw.width > kMaxSide || raw.height > kMaxSide) {
    throw std::invalid_argument("a frame may have at most " + std::to_string(kMaxSide) +
                                " px a side, got " + size_text(raw.width, raw.height) +
                                ": crop it, or run its parts one by one");
  }
  return raw;
}

}  // namespace

struct FramePreparer::State {
  FramesConfig config;
  Device device;
  std::unique_ptr<Background> model;
  FramePool pool;
  ResidentImage<float> background, structure;
  Image<float> noise;
  Image<std::uint8_t> ignored;
  std::vector<float> workspace;
  std::size_t pixel_type = 0;
  int width = 0, height = 0;  // of all frames; 0 before the first [px]
  int channels = 0, noise_step = 1;
  double floor = 0, sum_sigma = 0;
  std::int64_t frames = 0;

  State(const FramesConfig& c, const Device& d)
      : config(c), device(d), model(make_background(c, d)), pool(d) {}

  struct Grey {
    std::shared_ptr<Image<float>> image;
    bool masked;  ///< some pixel is NaN
  };

  Resident stage(const RawPixels& raw) const;
  bool masks() const { return ignored.width() > 0; }
  Grey take_grey(const RawPixels& raw);
  BackgroundInput input_of(const RawPixels& raw, FrameView grey) const {
    return {raw, grey, raw.channels == 1 && !config.reciprocal};
  }
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.width, s.height, s.pixel_type, s.channels, s.floor, s.sum_sigma, s.frames,
                    s.ignored);
  }
  void restored() const;
  void start(const RawPixels& raw);
  void make_maps();
  void check_like_first(const RawPixels& raw) const;
  void mask_background();
  void estimate_background(const BackgroundInput& input);
  Spread spread(FrameView image, FrameView less);
  void whiten(FrameView grey, double sigma, ImageView<float> whitened);
  void fill_masked(ImageView<float> grey) const;
};

/// Sends the frame ahead: grey pixels and the background's samples are made of it.
Resident FramePreparer::State::stage(const RawPixels& raw) const {
  return std::visit(
      [&]<class T>(const T* data) {
        return device.stage(
            ImageView<const T>{data, raw.width * raw.channels, raw.height, raw.pitch});
      },
      raw.data);
}

FramePreparer::State::Grey FramePreparer::State::take_grey(const RawPixels& raw) {
  if (width == 0) start(raw);
  check_like_first(raw);
  if (background.width() == 0) make_maps();
  Grey grey{pool.take(raw.width, raw.height), false};
  device.run<ToGrey>({raw, config.reciprocal, static_cast<float>(config.reciprocal_floor),
                      grey.image->view(), &grey.masked});
  return grey;
}

void FramePreparer::State::start(const RawPixels& raw) {
  pixel_type = raw.data.index();
  channels = raw.channels;
  width = raw.width, height = raw.height;
}

void FramePreparer::State::make_maps() {
  background = ResidentImage<float>(width, height, device);
  structure = ResidentImage<float>(width, height, device);
  const auto cells = [&](int step) {
    const int columns = (width + step - 1) / step, rows = (height + step - 1) / step;
    return static_cast<double>(columns) * rows;
  };
  while (cells(noise_step) > kNoiseSamples) noise_step += 2;
  noise =
      Image<float>((width + noise_step - 1) / noise_step, (height + noise_step - 1) / noise_step);
}

void FramePreparer::State::restored() const {
  require_bytes(pixel_type < std::variant_size_v<decltype(RawPixels::data)>,
                "there is no such type of pixel");
  require_bytes(width >= 0 && height >= 0 && (width == 0) == (height == 0),
                "frames have no such size");
  require_frame_number(frames);
}

void FramePreparer::State::check_like_first(const RawPixels& raw) const {
  if (raw.width != width || raw.height != height) {
    throw std::invalid_argument("frame " + std::to_string(frames) + " is " +
                                size_text(raw.width, raw.height) + " px, but the first was " +
                                size_text(width, height) +
                                " px: all frames of a stream must have one size");
  }
  if (raw.data.index() != pixel_type || raw.channels != channels) {
    throw std::invalid_argument("frame " + std::to_string(frames) +
                                " has another pixel type than the first: all frames of a stream "
                                "must have one");
  }
  if (masks() && (ignored.width() != raw.width || ignored.height() != raw.height)) {
    throw std::invalid_argument("the mask is " + size_text(ignored.width(), ignored.height()) +
                                " px, but frames are " + size_text(raw.width, raw.height) + " px");
  }
}

void FramePreparer::State::mask_background() {
  const ImageView<float> pixels = background.view();
  device.fetch(pixels);
  for (int y = 0; y < pixels.height; ++y) {
    const std::uint8_t* mask = ignored.view().row(y);
    for (int x = 0; x < pixels.width; ++x) {
      if (mask[x] != 0) pixels(x, y) = std::numeric_limits<float>::quiet_NaN();
    }
  }
  device.send(pixels);
}

void FramePreparer::State::estimate_background(const BackgroundInput& input) {
  if (!model->estimate(input, background.view())) return;
  if (masks()) mask_background();
  if (!config.structure) return;
  // One frame alone cannot tell structure from targets: its own gradient counts, and in full.
  const bool alone = model->provisional();
  device.run<BackgroundStructure>(
      {alone ? input.grey : background.view(), structure.view(), alone ? 1.0F : 0.5F});
}

Spread FramePreparer::State::spread(FrameView image, FrameView less) {
  Spread result;
  device.run<RobustSpread>({image, less, &workspace, &result});
  return result;
}

void FramePreparer::State::whiten(FrameView grey, double sigma, ImageView<float> whitened) {
  Whiten::Args args;
  args.image = grey;
  args.background = background.view();
  if (config.structure) args.structure = structure.view();
  args.sigma = sigma;
  args.ring_outer = config.ring ? config.ring_outer / 2 : 0;
  args.ring_inner = config.ring_inner / 2;
  args.ring_clip = config.ring_clip;
  args.polarity = config.polarity;
  args.clip_low = config.clip_low;
  args.clip_high = config.clip_high;
  args.whitened = whitened;
  args.noise_step = noise_step;
  args.noise = noise.view();
  device.run<Whiten>(args);
}

void FramePreparer::State::fill_masked(ImageView<float> grey) const {
  device.fetch(grey);
  device.fetch(background.view());
  for (int y = 0; y < grey.height; ++y) {
    const float* known = background.view().row(y);
    for (int x = 0; x < grey.width; ++x) {
      if (!std::isnan(grey(x, y))) continue;
      grey(x, y) = std::isnan(known[x]) ? 0.0F : known[x];
    }
  }
  device.send(grey);
}

FramePreparer::FramePreparer(const FramesConfig& config, const Device& device)
    : state_(std::make_unique<State>(valid(config), device)) {
  if (config.ring && config.ring_inner >= config.ring_outer) {
    throw ConfigError("frames.ring_inner must be below frames.ring_outer (" +
                      std::to_string(config.ring_outer) + "), got " +
                      std::to_string(config.ring_inner));
  }
}
FramePreparer::~FramePreparer() = default;
FramePreparer::FramePreparer(FramePreparer&&) noexcept = default;
FramePreparer& FramePreparer::operator=(FramePreparer&&) noexcept = default;

void FramePreparer::set_mask(Image<std::uint8_t> ignored) {
  state_->ignored = std::move(ignored);
  state_->model->rewrite();
}

void FramePreparer::learn(const RawPixels& given) {
  const RawPixels raw = fitting(given);
  const Resident sent = state_->stage(raw);
  const auto grey = state_->take_grey(raw).image;
  state_->model->learn(state_->input_of(raw, grey->view()));
}

Scan FramePreparer::prepare(const RawPixels& given, std::int64_t frame, double time) {
  State& s = *state_;
  const RawPixels raw = fitting(given);
  const Resident sent = s.stage(raw);
  const auto [grey, masked] = s.take_grey(raw);
  const BackgroundInput input = s.input_of(raw, grey->view());
  s.estimate_background(input);

  if (s.frames == 0) {
    s.device.fetch(grey->view());
    s.floor = s.config.sigma_floor > 0 ? s.config.sigma_floor
                                       : automatic_floor(raw, s.config.reciprocal, grey->view());
  }
  const double sigma = std::max(s.floor, s.spread(grey->view(), s.background.view()).sigma);
  const auto whitened = s.pool.take(raw.width, raw.height);
  s.whiten(grey->view(), sigma, whitened->view());
  s.model->learn(input);
  if (masked) s.fill_masked(grey->view());

  const double noise_sigma = s.spread(s.noise.view(), {}).median;
  s.sum_sigma += noise_sigma;
  ++s.frames;
  Scan scan;
  scan.frame = frame;
  scan.time = time;
  scan.raw = s.pool.frame(grey);
  scan.whitened = s.pool.frame(whitened);
  scan.noise_sigma = noise_sigma;
  return scan;
}

// The present background and its structure are not kept: the model gives them again.
void FramePreparer::save(ByteWriter& to) const {
  put_bytes(to, *state_);
  state_->model->save(to);
}

void FramePreparer::restore(ByteReader& from) {
  take_bytes(from, *state_);
  state_->background = {}, state_->structure = {}, state_->noise = {};  // those of a primed one
  state_->noise_step = 1;
  state_->model->restore(from, state_->width, state_->height);
  state_->model->rewrite();
}

std::vector<std::string> FramePreparer::notes() const {
  const State& s = *state_;
  if (s.frames == 0) return {};
  char text[96];
  std::snprintf(text, sizeof text, "noise sigma %.3g grey levels (mean of all frames), floor %.3g",
                s.sum_sigma / static_cast<double>(s.frames), s.floor);
  return {text, s.model->description()};
}

}  // namespace glint
