// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/modules/module.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

namespace glint {
namespace {

std::string path_of(const std::string& name) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  return (program.parent_path() / "lib/glint" / ("glint-" + name + ".so")).string();
}

[[noreturn]] void refuse(const std::string& path) {
  throw std::runtime_error(path + ": cannot be opened (" + dlerror() +
                           "); build the target glint_cli again, or install all of glint-tools");
}

}  // namespace

const void* open_module(const std::string& name) {
  const std::string path = path_of(name);
  void* const file = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (file == nullptr) refuse(path);
  using Table = const void* (*)();
  const auto table = reinterpret_cast<Table>(dlsym(file, "glint_module"));
  if (table == nullptr) refuse(path);
  return table();
}

}  // namespace glint
