// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "glint/frontends/files/raw_stream.hpp"
#include "input_file.hpp"
#include "refusals.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace glint;
  // "gray8 640x512"
  const std::string_view text = fuzz::text_of(data, size);
  const std::size_t end = std::min(text.find(' '), text.size());
  fuzz::or_refused(
      [&] { raw_format(text.substr(0, end), text.substr(std::min(end + 1, text.size()))); });
  return 0;
}
