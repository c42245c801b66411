// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/gl_queue.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <limits>
#include <utility>

namespace glint::gl {
namespace {

constexpr std::size_t kGroup = 64;         // GLINT_GROUP of prelude.glsl
constexpr std::size_t kMaxGroups = 65535;  // that every device takes along an axis
constexpr std::int32_t kMostBlocks = 10;   // that a pass uses: parameters and buffers

/// Capacity of a buffer: an eighth of its size is wasted at most, so that the pool's fit again.
std::size_t rounded(std::size_t bytes) {
  const std::size_t step = std::max<std::size_t>(256, std::bit_floor(bytes) / 8);
  return (std::max<std::size_t>(bytes, 1) + step - 1) / step * step;
}

}  // namespace

std::string size_text(std::size_t bytes) {
  constexpr std::size_t kMega = std::size_t{1} << 20;
  return bytes < kMega ? std::to_string(bytes) + " bytes" : std::to_string(bytes / kMega) + " MB";
}

Buffer::~Buffer() {
  if (queue_ != nullptr) queue_->pool_.push_back(place_);
}

Queue::Queue(const Api& api, const EglDevice& device, ProgramCache cache, bool debug)
    : api_(api), device_(device), staging_(api), programs_(api, device, std::move(cache)) {
  std::int64_t most = 0;
  api_.GetInteger64v(Api::kMaxStorageBlock, &most);
  constexpr std::int64_t kLargest = std::numeric_limits<std::int32_t>::max();
  limit(static_cast<std::size_t>(std::min(most, kLargest)));
  std::int32_t blocks = 0;
  api_.GetIntegerv(Api::kMaxStorageBlocks, &blocks);
  if (blocks < kMostBlocks) {
    fail("it gives a compute shader " + std::to_string(blocks) + " storage blocks, not the " +
         std::to_string(kMostBlocks) + " that are needed; use --device tbb");
  }
  if (!debug) return;
  api_.Enable(Api::kDebugOutput);
  api_.Enable(Api::kDebugSynchronous);
  api_.DebugMessageCallback(&on_debug, this);
}

Queue::~Queue() { drop_pool(); }

void Queue::on_debug(Enum, Enum type, unsigned, Enum, int, const char* message, const void* user) {
  auto* queue = static_cast<Queue*>(const_cast<void*>(user));
  if (type == Api::kDebugError && queue->debug_error_.empty()) queue->debug_error_ = message;
}

void Queue::check(const std::string& doing) {
  const Enum error = api_.GetError();
  const std::string message = std::exchange(debug_error_, {});
  if (error == Api::kOutOfMemory) {
    fail("out of memory " + doing + "; " + kSmallerRemedy);
  }
  if (error == Api::kContextLost) {
    fail("the driver lost the context " + doing + "; run again, or use --device tbb");
  }
  if (error != 0 || !message.empty()) {
    fail("error " + std::to_string(error) + " " + doing + " " + message +
         "; use --device tbb and report it with the output of glint info");
  }
}

void Queue::limit(std::size_t bytes) {
  max_bytes_ = std::min(max_bytes_.load(), std::max(bytes / kAligned * kAligned, kAligned));
}

Buffer Queue::take(std::size_t bytes) {
  if (bytes > max_bytes_) {
    fail("a buffer of " + size_text(bytes) + " is beyond its limit of " + size_text(max_bytes_) +
         "; use --device tbb");
  }
  return allocate(bytes);
}

Buffer Queue::allocate(std::size_t bytes) {
  const std::size_t capacity = rounded(bytes);
  const auto found = std::ranges::find(pool_, capacity, &Place::capacity);
  if (found != pool_.end()) {
    const Place place = *found;
    pool_.erase(found);
    return {this, place, bytes};
  }
  unsigned id = 0;
  api_.GenBuffers(1, &id);
  const auto made = [&] { return Buffer(this, Place{id, 0, capacity}, bytes); };
  if (reserve(id, capacity)) return made();
  drop_pool();
  if (reserve(id, capacity)) return made();
  api_.DeleteBuffers(1, &id);
  fail("no memory for a buffer of " + size_text(capacity) + "; " + kSmallerRemedy);
}

bool Queue::reserve(unsigned id, std::size_t capacity) {
  api_.BindBuffer(Api::kCopyBuffer, id);
  api_.BufferData(Api::kCopyBuffer, static_cast<std::ptrdiff_t>(capacity), nullptr,
                  Api::kDynamicCopy);
  const bool full = api_.GetError() == Api::kOutOfMemory;
  if (full) debug_error_.clear();
  return !full;
}

void Queue::drop_pool() {
  for (const Place& free : pool_) api_.DeleteBuffers(1, &free.id);
  pool_.clear();
}

void Queue::timed(double& seconds, FunctionRef<void()> work) {
  if (!timed_) return work();
  const auto start = std::chrono::steady_clock::now();
  work();
  api_.Finish();
  seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double Queue::copy_seconds(std::size_t bytes, int times) {
  const Buffer from = take(bytes), to = take(bytes);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < times; ++i) {
    api_.Finish();
    const auto start = std::chrono::steady_clock::now();
    copy(from.place_, to.place_, bytes);
    api_.Finish();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    least = std::min(least, taken.count());
  }
  return least;
}

void Queue::bind(unsigned binding, const Buffer& buffer) {
  const Place& place = buffer.place_;
  constexpr std::size_t kWord = sizeof(std::uint32_t);  // that shaders read bytes by
  const std::size_t size = std::max(kWord, (buffer.bytes_ + kWord - 1) / kWord * kWord);
  api_.BindBufferRange(Api::kStorageBuffer, binding, place.id,
                       static_cast<std::ptrdiff_t>(place.offset),
                       static_cast<std::ptrdiff_t>(size));
}

void Queue::dispatch(const Shader& shader, std::string_view pass, std::size_t items,
                     const Buffer& parameters, std::initializer_list<const Buffer*> buffers) {
  if (items == 0) return;
  api_.UseProgram(program(shader, pass));
  unsigned binding = 0;
  bind(binding++, parameters);
  for (const Buffer* buffer : buffers) bind(binding++, *buffer);
  const std::size_t groups = (items + kGroup - 1) / kGroup;
  const std::size_t columns = std::min(groups, kMaxGroups);
  const std::size_t rows = (groups + columns - 1) / columns;
  timed(traffic_.compute, [&] {
    api_.DispatchCompute(static_cast<unsigned>(columns), static_cast<unsigned>(rows), 1);
    api_.MemoryBarrier(Api::kAllBarriers);
  });
  check("in " + std::string(shader.name) + "." + std::string(pass));
}

unsigned Queue::program(const Shader& shader, std::string_view pass) {
  // What the driver says while a program is built is no error of the work that waits for it.
  try {
    const unsigned id = programs_.of(shader, pass);
    debug_error_.clear();
    return id;
  } catch (...) {
    debug_error_.clear();
    throw;
  }
}

}  // namespace glint::gl
