// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>

/// The part of EGL 1.5 and OpenGL 4.3 that Glint calls, by hand: building needs no header and no
/// library of a driver. All is found at run time; names are the standards' without prefix.
namespace glint::gl {

using Enum = unsigned;
using Handle = void*;

struct Egl {
  static constexpr Enum kPlatformDevice = 0x313F, kPlatformSurfaceless = 0x31DD;
  static constexpr Enum kOpenGlApi = 0x30A2;
  static constexpr int kExtensions = 0x3055;
  static constexpr std::int32_t kMajor = 0x3098, kMinor = 0x30FB, kProfile = 0x30FD, kCore = 1,
                                kDebug = 0x31B0, kResetStrategy = 0x31BD, kLoseOnReset = 0x31BF,
                                kNone = 0x3038;

  void* (*GetProcAddress)(const char*);
  std::int32_t (*GetError)();
  const char* (*QueryString)(Handle display, std::int32_t name);
  unsigned (*Initialize)(Handle display, std::int32_t* major, std::int32_t* minor);
  unsigned (*BindAPI)(Enum api);
  Handle (*CreateContext)(Handle display, Handle config, Handle share, const std::int32_t* list);
  unsigned (*DestroyContext)(Handle display, Handle context);
  unsigned (*MakeCurrent)(Handle display, Handle draw, Handle read, Handle context);
  unsigned (*ReleaseThread)();
  // Extensions; null where they are missing.
  Handle (*GetPlatformDisplayEXT)(Enum platform, Handle native, const std::int32_t* list);
  unsigned (*QueryDevicesEXT)(std::int32_t most, Handle* devices, std::int32_t* count);
  const char* (*QueryDeviceStringEXT)(Handle device, std::int32_t name);
};

struct Api {
  static constexpr Enum kOutOfMemory = 0x0505, kContextLost = 0x0507;
  static constexpr Enum kVendor = 0x1F00, kRenderer = 0x1F01, kVersion = 0x1F02,
                        kExtensions = 0x1F03, kNumExtensions = 0x821D;
  static constexpr Enum kComputeShader = 0x91B9, kCompileStatus = 0x8B81, kLinkStatus = 0x8B82;
  static constexpr Enum kNumProgramFormats = 0x87FE, kProgramBinaryLength = 0x8741,
                        kProgramRetrievable = 0x8257;
  static constexpr Enum kStorageBuffer = 0x90D2, kCopySource = 0x8F36, kCopyBuffer = 0x8F37,
                        kDynamicCopy = 0x88EA;
  static constexpr Enum kFloatWords = 0x822E, kRed = 0x1903, kFloat = 0x1406;
  static constexpr Enum kMaxStorageBlock = 0x90DE, kMaxStorageBlocks = 0x90DB;
  static constexpr unsigned kMapRead = 1, kMapWrite = 2, kMapInvalidate = 4, kMapPersistent = 0x40,
                            kMapCoherent = 0x80;
  static constexpr Enum kGpuDone = 0x9117, kTimeoutExpired = 0x911B;
  static constexpr unsigned kFlushCommands = 1;
  static constexpr unsigned kAllBarriers = 0xFFFFFFFF;
  static constexpr Enum kDebugOutput = 0x92E0, kDebugSynchronous = 0x8242, kDebugError = 0x824C;
  static constexpr Enum kDedicatedMemoryNvidia = 0x9047, kFreeMemoryAti = 0x87FC;  // [KiB]
  using DebugCallback = void (*)(Enum source, Enum type, unsigned id, Enum severity, int length,
                                 const char* message, const void* user);

  Enum (*GetError)();
  const unsigned char* (*GetString)(Enum name);
  const unsigned char* (*GetStringi)(Enum name, unsigned index);
  void (*GetIntegerv)(Enum name, std::int32_t* value);
  void (*GetInteger64v)(Enum name, std::int64_t* value);
  void (*Enable)(Enum what);
  void (*DebugMessageCallback)(DebugCallback callback, const void* user);

  unsigned (*CreateShader)(Enum kind);
  void (*ShaderSource)(unsigned shader, int count, const char* const* text, const int* length);
  void (*CompileShader)(unsigned shader);
  void (*GetShaderiv)(unsigned shader, Enum name, std::int32_t* value);
  void (*GetShaderInfoLog)(unsigned shader, int size, int* length, char* log);
  void (*DeleteShader)(unsigned shader);
  unsigned (*CreateProgram)();
  void (*AttachShader)(unsigned program, unsigned shader);
  void (*LinkProgram)(unsigned program);
  void (*GetProgramiv)(unsigned program, Enum name, std::int32_t* value);
  void (*GetProgramInfoLog)(unsigned program, int size, int* length, char* log);
  void (*DeleteProgram)(unsigned program);
  void (*UseProgram)(unsigned program);
  void (*ProgramParameteri)(unsigned program, Enum name, int value);
  void (*GetProgramBinary)(unsigned program, int size, int* length, Enum* format, void* binary);
  void (*ProgramBinary)(unsigned program, Enum format, const void* binary, int length);

  void (*GenBuffers)(int count, unsigned* buffers);
  void (*DeleteBuffers)(int count, const unsigned* buffers);
  void (*BindBuffer)(Enum target, unsigned buffer);
  void (*BindBufferRange)(Enum target, unsigned index, unsigned buffer, std::ptrdiff_t offset,
                          std::ptrdiff_t size);
  void (*BufferData)(Enum target, std::ptrdiff_t size, const void* data, Enum usage);
  void (*CopyBufferSubData)(Enum from, Enum to, std::ptrdiff_t at, std::ptrdiff_t to_at,
                            std::ptrdiff_t size);
  void (*ClearBufferSubData)(Enum target, Enum stored, std::ptrdiff_t offset, std::ptrdiff_t size,
                             Enum format, Enum type, const void* value);
  void* (*MapBufferRange)(Enum target, std::ptrdiff_t offset, std::ptrdiff_t size, unsigned access);
  unsigned char (*UnmapBuffer)(Enum target);
  void (*DispatchCompute)(unsigned x, unsigned y, unsigned z);
  void (*MemoryBarrier)(unsigned bits);
  void (*Finish)();
  Handle (*FenceSync)(Enum condition, unsigned flags);
  Enum (*ClientWaitSync)(Handle fence, unsigned flags, std::uint64_t timeout);
  void (*DeleteSync)(Handle fence);
  // Of OpenGL 4.4; null where it is missing.
  void (*BufferStorage)(Enum target, std::ptrdiff_t size, const void* data, unsigned flags);
};

/// Opens libEGL, which stays open. Throws std::runtime_error with the remedy where there is none.
Egl open_egl();
/// The functions of the context that is current on this thread. Throws std::runtime_error that
/// names a missing one.
Api load_api(const Egl& egl);
/// Whether EGL says so of a device, before it is opened.
bool calls_itself_software(const Egl& egl, Handle device);
/// Whether a list of extensions, separated by blanks, holds `name`; null is an empty list.
bool has_extension(const char* list, const char* name);

}  // namespace glint::gl
