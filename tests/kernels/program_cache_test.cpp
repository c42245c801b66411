// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/program_cache.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "egl.hpp"
#include "frontends/folder.hpp"
#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"

namespace glint {
namespace {

using gl::ProgramCache;
using test::Folder;

ProgramCache::Program program(unsigned format, std::string_view bytes) {
  return {format, {bytes.begin(), bytes.end()}};
}

std::string bytes_of(const std::optional<ProgramCache::Program>& found) {
  return found ? std::string(found->bytes.begin(), found->bytes.end()) : "nothing";
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  return files;
}

/// Sets a variable of the environment, or takes it away, for one test.
class Setting {
 public:
  Setting(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    set(value);
  }
  ~Setting() { set(before_ ? before_->c_str() : nullptr); }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;

 private:
  void set(const char* value) const {
    value == nullptr ? unsetenv(name_) : setenv(name_, value, 1);
  }
  const char* name_;
  std::optional<std::string> before_;
};

TEST(ProgramCache, FindsWhatWasKeptForTheText) {
  const Folder folder;
  const ProgramCache cache(folder.path(), "driver 1");
  EXPECT_FALSE(cache.find("a"));
  cache.keep("a", program(7, "binary a"));
  cache.keep("b", program(8, ""));
  EXPECT_EQ(bytes_of(cache.find("a")), "binary a");
  EXPECT_EQ(cache.find("a")->format, 7u);
  EXPECT_EQ(bytes_of(cache.find("b")), "");
  EXPECT_FALSE(cache.find("c"));
  cache.keep("a", program(9, "binary a, again"));
  EXPECT_EQ(bytes_of(cache.find("a")), "binary a, again");
  EXPECT_EQ(files_in(folder.path()).size(), 2u);
}

TEST(ProgramCache, FindsNothingOfAnotherDriver) {
  const Folder folder;
  ProgramCache(folder.path(), "driver 1").keep("a", program(7, "binary a"));
  EXPECT_FALSE(ProgramCache(folder.path(), "driver 2").find("a"));
  EXPECT_EQ(bytes_of(ProgramCache(folder.path(), "driver 1").find("a")), "binary a");
}

TEST(ProgramCache, FindsNothingInAFileCutShortOrChanged) {
  const Folder folder;
  const ProgramCache cache(folder.path(), "driver 1");
  for (std::size_t at = 0; at < 40; ++at) {
    cache.keep("a", program(7, "binary a"));
    const std::string path = files_in(folder.path()).at(0).string();
    std::string whole = test::content_of(path);
    test::truncate(path, static_cast<double>(at) / 40);
    EXPECT_FALSE(cache.find("a")) << at;
    // Bytes 32 to 39 are the format, which may be anything.
    if (at >= 32) continue;
    whole[at] = static_cast<char>(whole[at] ^ 1);
    std::ofstream(path, std::ios::binary) << whole;
    EXPECT_FALSE(cache.find("a")) << at;
  }
  cache.keep("a", program(7, "binary a"));
  const std::string path = files_in(folder.path()).at(0).string();
  std::string whole = test::content_of(path);
  whole.back() = 'b';
  std::ofstream(path, std::ios::binary) << whole;
  EXPECT_FALSE(cache.find("a"));
}

TEST(ProgramCache, KeepsNothingWhereNothingCanBeWritten) {
  const Folder folder;
  const std::string file = folder.write("file", "not a folder");
  for (const std::string& nowhere : {file, std::string(), std::string("/proc/glint")}) {
    const ProgramCache cache(nowhere, "driver 1");
    cache.keep("a", program(7, "binary a"));
    EXPECT_FALSE(cache.find("a")) << nowhere;
  }
  EXPECT_EQ(test::content_of(file), "not a folder");
}

TEST(ProgramCache, ShowsWholeFilesOnlyWhileManyWrite) {
  const Folder folder;
  std::atomic<bool> wrong = false;
  std::vector<std::thread> threads;
  for (const char letter : {'a', 'b', 'c', 'd'}) {
    threads.emplace_back([&, letter] {
      const ProgramCache cache(folder.path(), "driver 1");
      for (int i = 0; i < 200; ++i) {
        cache.keep("text", program(7, std::string(5000, letter)));
        const std::string found = bytes_of(cache.find("text"));
        if (found.size() != 5000 || found != std::string(5000, found[0])) wrong = true;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_FALSE(wrong);
  EXPECT_EQ(files_in(folder.path()).size(), 1u) << "drafts were left";
}

TEST(ProgramCache, LiesWhereTheUserKeepsSuchThings) {
  {
    const Setting cache("XDG_CACHE_HOME", "/some/cache"), home("HOME", "/home/me");
    EXPECT_EQ(ProgramCache::user_folder(), "/some/cache/glint");
  }
  for (const char* none : {static_cast<const char*>(nullptr), "", "relative"}) {
    const Setting cache("XDG_CACHE_HOME", none), home("HOME", "/home/me");
    EXPECT_EQ(ProgramCache::user_folder(), "/home/me/.cache/glint");
  }
  const Setting cache("XDG_CACHE_HOME", nullptr), home("HOME", nullptr);
  EXPECT_EQ(ProgramCache::user_folder(), "");
}

// A shader that multiplies by a number, in the text that the cache sees.
std::string multiplying_by(const char* factor) {
  return "#version 430 core\nlayout(local_size_x = 64) in;\n"
         "layout(std430, binding = 0) readonly buffer Parameters { uint unused; };\n"
         "layout(std430, binding = 1) buffer Values { uint values[]; };\n"
         "void multiply() { if (gl_GlobalInvocationID.x == 0u) values[0] *= " +
         std::string(factor) + "u; }\n";
}
std::string with_main(const std::string& text) { return text + "\nvoid main() { multiply(); }\n"; }

/// 7 times the factor, by a program of a context of its own.
std::uint32_t seven_times(const std::string& shader) {
  const Device device = Device::egl();
  std::uint32_t value = 7;
  device.context().run([&](gl::Queue& queue) {
    const gl::Buffer there = queue.upload(std::span<const std::uint32_t>(&value, 1));
    queue.run({"multiply", shader.c_str()}, "multiply", 1, 0u, {&there});
    queue.read(there, std::span(&value, 1));
  });
  return value;
}

/// The cache that contexts of `device` use.
ProgramCache cache_of(const Device& device) {
  const EglDevice& d = device.context().device();
  return {ProgramCache::user_folder(), d.vendor + '\n' + d.renderer + '\n' + d.driver};
}

TEST(EglPrograms, ComeFromTheCacheTheNextTime) {
  GLINT_NEEDS_EGL(device);
  const Folder folder;
  const Setting setting("XDG_CACHE_HOME", folder.path().c_str());
  const std::string by_two = multiplying_by("2"), by_three = multiplying_by("3");
  EXPECT_EQ(seven_times(by_two), 14u);
  EXPECT_EQ(seven_times(by_three), 21u);
  const ProgramCache cache = cache_of(device);
  const auto kept = cache.find(with_main(by_three));
  if (!kept) GTEST_SKIP() << "this driver gives no program away";
  // Whoever takes the program for the factor 2 from the cache now multiplies by 3.
  cache.keep(with_main(by_two), *kept);
  EXPECT_EQ(seven_times(by_two), 21u);
}

TEST(EglPrograms, AreCompiledAgainIfTheDriverRefusesWhatWasKept) {
  GLINT_NEEDS_EGL(device);
  const Folder folder;
  const Setting setting("XDG_CACHE_HOME", folder.path().c_str());
  const std::string by_two = multiplying_by("2");
  EXPECT_EQ(seven_times(by_two), 14u);
  const ProgramCache cache = cache_of(device);
  const auto kept = cache.find(with_main(by_two));
  if (!kept) GTEST_SKIP() << "this driver gives no program away";
  // As after an update that left the driver's name as it was.
  ProgramCache::Program of_another = *kept;
  for (std::size_t i = 0; i < std::min<std::size_t>(64, of_another.bytes.size()); ++i) {
    of_another.bytes[i] = static_cast<char>(of_another.bytes[i] ^ 0x55);
  }
  cache.keep(with_main(by_two), of_another);
  EXPECT_EQ(seven_times(by_two), 14u);
  EXPECT_EQ(cache.find(with_main(by_two))->bytes, kept->bytes) << "it was not replaced";
  ProgramCache::Program of_no_format = *kept;
  of_no_format.format = 1;
  cache.keep(with_main(by_two), of_no_format);
  EXPECT_EQ(seven_times(by_two), 14u);
}

TEST(EglPrograms, AreCompiledWhereNothingCanBeKept) {
  GLINT_NEEDS_EGL(device);
  const Folder folder;
  const std::string file = folder.write("file", "not a folder");
  const Setting setting("XDG_CACHE_HOME", file.c_str());
  EXPECT_EQ(seven_times(multiplying_by("2")), 14u);
  EXPECT_EQ(test::content_of(file), "not a folder");
}

}  // namespace
}  // namespace glint
