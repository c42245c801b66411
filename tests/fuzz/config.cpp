// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/run_config.hpp"
#include "glint/frontends/cli/config_file.hpp"
#include "input_file.hpp"
#include "refusals.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace glint;
  const std::string path = fuzz::input_file(fuzz::text_of(data, size), ".toml");
  fuzz::or_refused([&] {
    auto sections = all_sections();
    cli::read_config(path, sections);
  });
  return 0;
}
