// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <string>

#include "glint.h"
#include "input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string config(glint::fuzz::text_of(data, size));
  glint_options options = GLINT_OPTIONS_INIT;
  options.config = config.c_str();
  glint_engine* engine = nullptr;
  const glint_status status = glint_create(&options, &engine);
  if ((status == GLINT_OK) != (engine != nullptr)) std::abort();
  if (status != GLINT_OK && *glint_last_error() == '\0') std::abort();
  glint_destroy(engine);
  return 0;
}
