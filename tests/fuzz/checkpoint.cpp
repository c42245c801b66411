// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <exception>
#include <utility>
#include <vector>

#include "glint/engine/scheduler.hpp"
#include "glint/engine/trackers/registry.hpp"
#include "input_file.hpp"

namespace glint::fuzz {
namespace {

constexpr int kSide = 16;

struct OneFrame : Source {
  explicit OneFrame(std::int64_t f) : number(f), pixels(kSide * kSide) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      pixels[i] = static_cast<std::uint8_t>(60 + (i * 37 + static_cast<std::size_t>(f) * 11) % 13);
    }
    pixels[static_cast<std::size_t>(5 * kSide + 3 + f % 10)] = 250;
  }
  std::optional<SourceFrame> next() override {
    if (std::exchange(given, true)) return std::nullopt;
    SourceFrame frame;
    frame.pixels = {static_cast<const std::uint8_t*>(pixels.data()), kSide, kSide, 1, kSide};
    frame.time = static_cast<double>(number);
    return frame;
  }
  std::int64_t number;
  std::vector<std::uint8_t> pixels;
  bool given = false;
};

void track(Scheduler& scheduler, std::int64_t frame) {
  OneFrame source(frame);
  scheduler.advance(source);
}

/// Of one thread and few particles.
Scheduler scheduler_of(const TrackerEntry& entry) {
  const Device device = Device::tbb(1);
  ConfigSection section = entry.config();
  for (ConfigField& field : section.fields()) {
    constexpr std::array kFew{"birth_particles", "particles_per_target", "target_particles",
                              "particles"};
    if (std::ranges::find(kFew, field.key) != kFew.end()) assign_text(field, "30");
  }
  Scheduler scheduler(device, FramePreparer(FramesConfig{}, device));
  scheduler.add(entry.make(section, device, 1), std::string(entry.name));
  return scheduler;
}

/// After `frames` frames.
std::string checkpoint_of(const TrackerEntry& entry, std::int64_t frames) {
  Scheduler scheduler = scheduler_of(entry);
  for (std::int64_t f = 0; f < frames; ++f) track(scheduler, f);
  return scheduler.checkpoint();
}

/// Bytes of the state are overwritten: four of the input are where, then what.
void damage(std::string& state, std::string_view input) {
  for (; input.size() >= 4 && !state.empty(); input.remove_prefix(4)) {
    std::size_t at = 0;
    for (int i = 2; i >= 0; --i) at = at << 8 | static_cast<unsigned char>(input[std::size_t(i)]);
    state[at % state.size()] = input[3];
  }
  if (input.size() == 1) {  // left over: how much there is of it
    state.resize(state.size() * static_cast<unsigned char>(input[0]) / 256);
  }
}

}  // namespace
}  // namespace glint::fuzz

/// The number of a tracker, of frames, and what is wrong with the state after them. The checksum is
/// right: the readers behind it are what is tried.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace glint;
  if (size < 2) return 0;
  const TrackerEntry& entry = all_trackers()[data[0] % all_trackers().size()];
  const std::int64_t frames = data[1] % 16;
  const std::string bytes = fuzz::checkpoint_of(entry, frames);
  const OpenCheckpoint open = open_checkpoint(bytes);
  std::string state = bytes.substr(bytes.size() - open.state.left());
  fuzz::damage(state, fuzz::text_of(data + 2, size - 2));
  ByteWriter to = begin_checkpoint(open.label);
  to.raw(state.data(), state.size());
  Scheduler scheduler = fuzz::scheduler_of(entry);
  try {
    scheduler.restore(seal_checkpoint(std::move(to)));
  } catch (const CheckpointError&) {
    return 0;
  }
  try {  // wrong numbers that could be right: what is tracked may be nonsense
    for (int f = 0; f < 3; ++f) fuzz::track(scheduler, frames + f);
    scheduler.finish();
  } catch (const std::exception&) {
    return 0;
  }
  return 0;
}
