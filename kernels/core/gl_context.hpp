// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "glint/kernels/core/egl_devices.hpp"
#include "glint/kernels/core/function_ref.hpp"
#include "glint/kernels/core/gl_api.hpp"
#include "glint/kernels/core/gl_staging.hpp"

namespace glint::gl {

class Queue;

/// A device as EGL names it, before it is opened.
struct Candidate {
  Enum platform = Egl::kPlatformDevice;
  Handle device = nullptr;
};

/// An OpenGL context and the one thread that it is current on. Kernels from any thread queue up.
class Context {
 public:
  /// Throws std::runtime_error if the device opens no context of OpenGL 4.3 or later.
  Context(const Egl& egl, Candidate candidate, int number);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  const EglDevice& device() const { return device_; }

  /// Runs task(queue) on the context's thread, after those that came before, and waits for it. What
  /// it throws comes out here.
  void run(FunctionRef<void(Queue&)> task);
  /// A slot of at least this size for the calling thread to fill; nothing if the driver has none.
  /// Waits for the context's thread only if none is free.
  std::optional<StagingSlot> staging_slot(std::size_t bytes);
  /// Largest buffer that a pass sees.
  std::size_t max_bytes() const;

 private:
  struct Job {
    FunctionRef<void(Queue&)> task;
    bool done = false;
    std::exception_ptr error = nullptr;
  };
  void serve(const Egl& egl, Candidate candidate);
  void serve_jobs(Queue& queue);

  EglDevice device_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job*> jobs_;
  bool ready_ = false, closing_ = false;
  Queue* queue_ = nullptr;      ///< the thread's, from ready_ on
  std::exception_ptr failure_;  ///< of opening
  std::thread thread_;
};

}  // namespace glint::gl
