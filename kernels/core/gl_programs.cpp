// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/gl_programs.hpp"

#include <array>
#include <stdexcept>
#include <utility>

namespace glint::gl {

void fail(const EglDevice& device, const std::string& what) {
  throw std::runtime_error("egl:" + std::to_string(device.number) + " (" + device.renderer +
                           "): " + what);
}

Programs::Programs(const Api& api, const EglDevice& device, ProgramCache cache)
    : api_(api), device_(device), cache_(std::move(cache)) {
  std::int32_t formats = 0;
  api_.GetIntegerv(Api::kNumProgramFormats, &formats);
  takes_binaries_ = formats > 0;
}

Programs::~Programs() {
  for (const auto& [name, program] : programs_) api_.DeleteProgram(program);
}

unsigned Programs::of(const Shader& shader, std::string_view pass) {
  const std::string name = std::string(shader.name) + '.' + std::string(pass);
  const auto found = programs_.find(name);
  if (found != programs_.end()) return found->second;
  const std::string text = shader.text + ("\nvoid main() { " + std::string(pass) + "(); }\n");
  unsigned program = loaded(text);
  if (program == 0) {
    program = compiled(text, name);
    keep(text, program);
  }
  return programs_.emplace(name, program).first->second;
}

/// 0 if there is none that the driver takes.
unsigned Programs::loaded(const std::string& text) {
  if (!takes_binaries_) return 0;
  const auto kept = cache_.find(text);
  if (!kept) return 0;
  const unsigned program = api_.CreateProgram();
  api_.ProgramBinary(program, kept->format, kept->bytes.data(),
                     static_cast<int>(kept->bytes.size()));
  std::int32_t ok = 0;
  api_.GetProgramiv(program, Api::kLinkStatus, &ok);
  if (ok != 0) return program;
  api_.DeleteProgram(program);
  api_.GetError();  // that it refused
  return 0;
}

unsigned Programs::compiled(const std::string& text, const std::string& name) {
  const unsigned shader = api_.CreateShader(Api::kComputeShader);
  const char* const source = text.c_str();
  api_.ShaderSource(shader, 1, &source, nullptr);
  api_.CompileShader(shader);
  std::array<char, 2048> log{};
  std::int32_t ok = 0;
  api_.GetShaderiv(shader, Api::kCompileStatus, &ok);
  if (ok == 0) api_.GetShaderInfoLog(shader, log.size() - 1, nullptr, log.data());
  const unsigned program = api_.CreateProgram();
  if (ok != 0) {
    api_.ProgramParameteri(program, Api::kProgramRetrievable, 1);
    api_.AttachShader(program, shader);
    api_.LinkProgram(program);
    api_.GetProgramiv(program, Api::kLinkStatus, &ok);
    if (ok == 0) api_.GetProgramInfoLog(program, log.size() - 1, nullptr, log.data());
  }
  api_.DeleteShader(shader);
  if (ok != 0) return program;
  api_.DeleteProgram(program);
  api_.GetError();  // the log says more
  fail(device_,
       name + " does not compile: " + log.data() + "; update the driver or use --device tbb");
}

void Programs::keep(const std::string& text, unsigned program) {
  if (!takes_binaries_) return;
  std::int32_t bytes = 0;
  api_.GetProgramiv(program, Api::kProgramBinaryLength, &bytes);
  if (bytes <= 0) return;
  ProgramCache::Program kept{0, std::vector<char>(static_cast<std::size_t>(bytes))};
  int written = 0;
  api_.GetProgramBinary(program, bytes, &written, &kept.format, kept.bytes.data());
  if (api_.GetError() != 0 || written <= 0) return;
  kept.bytes.resize(static_cast<std::size_t>(written));
  cache_.keep(text, kept);
}

}  // namespace glint::gl
