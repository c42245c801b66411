// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/cued_source.hpp"
#include "input_file.hpp"
#include "refusals.hpp"

namespace {

/// Eight frames of 4x4 pixels.
class Film : public glint::Source {
 public:
  std::optional<glint::SourceFrame> next() override {
    if (frame_ == 8) return std::nullopt;
    glint::SourceFrame frame;
    frame.pixels = {pixels_, 4, 4};
    frame.time = 0.5 * frame_++;
    return frame;
  }

 private:
  std::uint8_t pixels_[16] = {};
  int frame_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace glint;
  const std::string path = fuzz::input_file(fuzz::text_of(data, size), ".csv");
  fuzz::or_refused([&] {
    const auto source = with_cues(
        std::make_unique<Film>(), path, [](const std::string&) {}, 2);
    while (source->next()) continue;
  });
  return 0;
}
