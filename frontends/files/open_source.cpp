// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/open_source.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "glint/engine/scenario/scenario.hpp"
#include "glint/frontends/files/inputs.hpp"
#include "glint/frontends/files/npy.hpp"
#include "glint/frontends/files/points_source.hpp"
#include "glint/frontends/files/sequence.hpp"
#include "glint/frontends/modules/fits.hpp"
#include "glint/frontends/modules/video.hpp"

namespace glint {
namespace {

constexpr std::string_view kScene = "scene:";
constexpr std::string_view kStandardInput = "-";

std::unique_ptr<Source> open_picture(const std::string& path, InputKind kind, const Warn& warn) {
  if (!has_video()) {
    throw UsageError(path +
                     ": this glint was built without OpenCV and reads no images or videos; "
                     "give .npy, FITS or scene:NAME");
  }
  return kind == InputKind::video ? video().open_video(path, warn) : video().open_image(path);
}

std::unique_ptr<Source> open_file(const std::string& path, const Warn& warn) {
  switch (const InputKind kind = kind_of(path)) {
    case InputKind::fits:
      return fits().open_fits(path);
    case InputKind::npy:
      return open_npy(path);
    default:
      return open_picture(path, kind, warn);
  }
}

std::unique_ptr<Source> open_scene(std::string_view name, const SourceOptions& options) {
  const SceneEntry& entry = find_scene(name);
  Scene scene = entry.make(options.scene ? *options.scene : entry.config());
  if (options.frame_rate) scene.interval = 1 / *options.frame_rate;
  return std::make_unique<SceneSource>(std::move(scene), options.seed);
}

std::unique_ptr<Source> open_raw_input(std::span<const std::string> inputs,
                                       const SourceOptions& options) {
  if (inputs.size() > 1) {
    throw UsageError(inputs[1] + ": raw frames come from one input; cat the files into it");
  }
  return open_raw(inputs.front(), *options.raw, options.frame_rate);
}

}  // namespace

std::optional<std::string_view> scene_name(std::string_view input) {
  if (!input.starts_with(kScene)) return std::nullopt;
  return input.substr(kScene.size());
}

std::unique_ptr<Source> open_source(std::span<const std::string> inputs,
                                    const SourceOptions& options) {
  if (inputs.empty()) throw UsageError("no input; give a video, images or scene:NAME");
  if (const auto name = scene_name(inputs.front()); name && inputs.size() == 1) {
    return open_scene(*name, options);
  }
  if (options.raw) return open_raw_input(inputs, options);
  for (const std::string& input : inputs) {
    if (input == kStandardInput) {
      throw UsageError(
          "-: frames from standard input need --format and --size, e.g. --format "
          "gray16le --size 640x512");
    }
    if (scene_name(input)) throw UsageError(input + ": a scene must be the only input");
  }
  std::vector<std::string> files = expand_inputs(inputs, options.warn);
  if (files.size() == 1 && kind_of(files.front()) == InputKind::points) {
    return open_points(files.front(), options.frame_rate);
  }
  for (const std::string& file : files) {
    if (kind_of(file) == InputKind::points) {
      throw UsageError(file + ": a file of points must be the only input");
    }
  }
  std::optional<std::int64_t> frames;  // known beforehand if every file is one frame
  if (std::ranges::all_of(files, [](auto& f) { return kind_of(f) == InputKind::image; })) {
    frames = static_cast<std::int64_t>(files.size());
  }
  auto open = [warn = options.warn](const std::string& path) { return open_file(path, warn); };
  return std::make_unique<SequenceSource>(std::move(files), std::move(open), options.frame_rate,
                                          frames);
}

}  // namespace glint
