// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/tables.hpp"
#include "input_file.hpp"
#include "refusals.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace glint;
  const std::string path = fuzz::input_file(fuzz::text_of(data, size), ".csv");
  fuzz::or_refused([&] { read_tracks(path); });
  fuzz::or_refused([&] { read_truth(path); });
  fuzz::or_refused([&] { read_points(path); });
  return 0;
}
