// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "glint/frontends/files/autoferry.hpp"
#include "input_file.hpp"
#include "refusals.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace glint;
  // Detections, a zero, truth: two files in one.
  const std::string_view text = fuzz::text_of(data, size);
  const std::size_t end = std::min(text.find('\0'), text.size());
  const std::string detections = fuzz::input_file(text.substr(0, end), "_detections.json");
  const std::string truth =
      fuzz::input_file(text.substr(std::min(end + 1, text.size())), "_truth.json");
  fuzz::or_refused([&] { read_autoferry(detections, truth, BoatSensor::radar); });
  return 0;
}
