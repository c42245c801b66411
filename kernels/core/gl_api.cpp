// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/gl_api.hpp"

#include <dlfcn.h>

#include <stdexcept>
#include <string>
#include <string_view>

namespace glint::gl {
namespace {

constexpr const char* kLibrary = "libEGL.so.1";

template <class F>
void find(F& function, void* address) {
  function = reinterpret_cast<F>(address);
}

template <class F>
void require(F& function, void* address, const char* name) {
  if (address == nullptr) {
    throw std::runtime_error(std::string("no EGL device: the driver lacks ") + name +
                             "; update it or use --device tbb");
  }
  find(function, address);
}

}  // namespace

Egl open_egl() {
  void* library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    throw std::runtime_error(std::string("no EGL device: ") + dlerror() +
                             "; install EGL and a driver (Debian: libegl1 libgl1-mesa-dri) or use "
                             "--device tbb");
  }
  Egl egl{};
  const auto core = [&](auto& function, const char* name) {
    require(function, dlsym(library, name), name);
  };
  core(egl.GetProcAddress, "eglGetProcAddress");
  core(egl.GetError, "eglGetError");
  core(egl.QueryString, "eglQueryString");
  core(egl.Initialize, "eglInitialize");
  core(egl.BindAPI, "eglBindAPI");
  core(egl.CreateContext, "eglCreateContext");
  core(egl.DestroyContext, "eglDestroyContext");
  core(egl.MakeCurrent, "eglMakeCurrent");
  core(egl.ReleaseThread, "eglReleaseThread");
  find(egl.GetPlatformDisplayEXT, egl.GetProcAddress("eglGetPlatformDisplayEXT"));
  find(egl.QueryDevicesEXT, egl.GetProcAddress("eglQueryDevicesEXT"));
  find(egl.QueryDeviceStringEXT, egl.GetProcAddress("eglQueryDeviceStringEXT"));
  return egl;
}

Api load_api(const Egl& egl) {
  Api api{};
  const auto load = [&](auto& function, const char* name) {
    require(function, egl.GetProcAddress(name), name);
  };
  load(api.GetError, "glGetError");
  load(api.GetString, "glGetString");
  load(api.GetStringi, "glGetStringi");
  load(api.GetIntegerv, "glGetIntegerv");
  load(api.GetInteger64v, "glGetInteger64v");
  load(api.Enable, "glEnable");
  load(api.DebugMessageCallback, "glDebugMessageCallback");
  load(api.CreateShader, "glCreateShader");
  load(api.ShaderSource, "glShaderSource");
  load(api.CompileShader, "glCompileShader");
  load(api.GetShaderiv, "glGetShaderiv");
  load(api.GetShaderInfoLog, "glGetShaderInfoLog");
  load(api.DeleteShader, "glDeleteShader");
  load(api.CreateProgram, "glCreateProgram");
  load(api.AttachShader, "glAttachShader");
  load(api.LinkProgram, "glLinkProgram");
  load(api.GetProgramiv, "glGetProgramiv");
  load(api.GetProgramInfoLog, "glGetProgramInfoLog");
  load(api.DeleteProgram, "glDeleteProgram");
  load(api.UseProgram, "glUseProgram");
  load(api.ProgramParameteri, "glProgramParameteri");
  load(api.GetProgramBinary, "glGetProgramBinary");
  load(api.ProgramBinary, "glProgramBinary");
  load(api.GenBuffers, "glGenBuffers");
  load(api.DeleteBuffers, "glDeleteBuffers");
  load(api.BindBuffer, "glBindBuffer");
  load(api.BindBufferRange, "glBindBufferRange");
  load(api.BufferData, "glBufferData");
  load(api.CopyBufferSubData, "glCopyBufferSubData");
  load(api.ClearBufferSubData, "glClearBufferSubData");
  load(api.MapBufferRange, "glMapBufferRange");
  load(api.UnmapBuffer, "glUnmapBuffer");
  load(api.DispatchCompute, "glDispatchCompute");
  load(api.MemoryBarrier, "glMemoryBarrier");
  load(api.Finish, "glFinish");
  load(api.FenceSync, "glFenceSync");
  load(api.ClientWaitSync, "glClientWaitSync");
  load(api.DeleteSync, "glDeleteSync");
  find(api.BufferStorage, egl.GetProcAddress("glBufferStorage"));
  return api;
}

bool calls_itself_software(const Egl& egl, Handle device) {
  return has_extension(egl.QueryDeviceStringEXT(device, Egl::kExtensions),
                       "EGL_MESA_device_software");
}

bool has_extension(const char* list, const char* name) {
  if (list == nullptr) return false;
  const std::string padded = ' ' + std::string(list) + ' ';
  return padded.find(' ' + std::string(name) + ' ') != std::string::npos;
}

}  // namespace glint::gl
