// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <string>
#include <string_view>

#include "glint/kernels/core/egl_devices.hpp"
#include "glint/kernels/core/gl_api.hpp"
#include "glint/kernels/core/program_cache.hpp"

namespace glint::gl {

/// GLSL that the build embeds: functions without arguments, each of which is a pass.
struct Shader {
  std::string_view name;
  const char* text;
};

/// Throws std::runtime_error that names the device.
[[noreturn]] void fail(const EglDevice& device, const std::string& what);

/// The programs of a context, one a pass of a shader, each from the cache or compiled, and then
/// kept there.
class Programs {
 public:
  Programs(const Api& api, const EglDevice& device, ProgramCache cache);
  ~Programs();
  Programs(const Programs&) = delete;
  Programs& operator=(const Programs&) = delete;

  /// Throws as fail() does, with the driver's words and the remedy, if the shader does not compile.
  unsigned of(const Shader& shader, std::string_view pass);

 private:
  unsigned loaded(const std::string& text);
  unsigned compiled(const std::string& text, const std::string& name);
  void keep(const std::string& text, unsigned program);

  const Api& api_;
  const EglDevice& device_;
  ProgramCache cache_;
  bool takes_binaries_ = false;
  std::map<std::string, unsigned, std::less<>> programs_;
};

}  // namespace glint::gl
