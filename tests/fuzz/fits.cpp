// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/fits.hpp"
#include "input_file.hpp"
#include "refusals.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace glint;
  const std::string path = fuzz::input_file(fuzz::text_of(data, size), ".fits");
  fuzz::or_refused([&] {
    const auto source = open_fits(path);
    for (int frames = 0; frames < 4 && source->next(); ++frames) {
    }
  });
  return 0;
}
