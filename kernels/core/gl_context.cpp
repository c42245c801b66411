// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/gl_context.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "glint/kernels/core/gl_queue.hpp"

namespace glint::gl {
namespace {

#ifdef NDEBUG
constexpr std::int32_t kDebug = 0;
#else
constexpr std::int32_t kDebug = 1;
#endif

/// A display and a context on it, current on this thread while it lives. The display is never
/// terminated: it is the process's, and others may have contexts on it.
class Current {
 public:
  Current(const Egl& egl, Candidate candidate) : egl_(egl) {
    display_ = egl.GetPlatformDisplayEXT(candidate.platform, candidate.device, nullptr);
    if (display_ == nullptr || egl.Initialize(display_, nullptr, nullptr) == 0) {
      throw std::runtime_error("its display cannot be initialised");
    }
    if (egl.BindAPI(Egl::kOpenGlApi) == 0) throw std::runtime_error("it has no desktop OpenGL");
    context_ = newest_context();
    if (egl.MakeCurrent(display_, nullptr, nullptr, context_) == 0) {
      egl.DestroyContext(display_, context_);
      throw std::runtime_error("its context takes no work without a display");
    }
  }
  ~Current() {
    egl_.MakeCurrent(display_, nullptr, nullptr, nullptr);
    egl_.DestroyContext(display_, context_);
    egl_.ReleaseThread();
  }
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;

 private:
  /// The newest version that there is; one that tells of a reset, if it can.
  Handle newest_context() const {
    for (const std::int32_t minor : {5, 3}) {
      for (const std::int32_t reset : {Egl::kResetStrategy, Egl::kNone}) {
        const std::array list{Egl::kMajor, 4,           Egl::kMinor, minor, Egl::kProfile,
                              Egl::kCore,  Egl::kDebug, kDebug,      reset, Egl::kLoseOnReset,
                              Egl::kNone};
        Handle context = egl_.CreateContext(display_, nullptr, nullptr, list.data());
        if (context != nullptr) return context;
      }
    }
    throw std::runtime_error("it has no OpenGL 4.3");
  }

  const Egl& egl_;
  Handle display_ = nullptr, context_ = nullptr;
};

bool has_gl_extension(const Api& api, const std::string& name) {
  std::int32_t count = 0;
  api.GetIntegerv(Api::kNumExtensions, &count);
  for (std::int32_t i = 0; i < count; ++i) {
    const auto* text = api.GetStringi(Api::kExtensions, static_cast<unsigned>(i));
    if (name == reinterpret_cast<const char*>(text)) return true;
  }
  return false;
}

std::uint64_t memory_of(const Api& api) {
  std::array<std::int32_t, 4> kibibytes{};
  if (has_gl_extension(api, "GL_NVX_gpu_memory_info")) {
    api.GetIntegerv(Api::kDedicatedMemoryNvidia, kibibytes.data());
  } else if (has_gl_extension(api, "GL_ATI_meminfo")) {
    api.GetIntegerv(Api::kFreeMemoryAti, kibibytes.data());
  }
  return static_cast<std::uint64_t>(kibibytes[0]) << 10;
}

bool is_software(const Egl& egl, Candidate candidate, const std::string& renderer) {
  if (candidate.device != nullptr && calls_itself_software(egl, candidate.device)) return true;
  constexpr std::array kNames{"llvmpipe", "softpipe", "SwiftShader", "Software Rasterizer"};
  return std::ranges::any_of(
      kNames, [&](const char* name) { return renderer.find(name) != std::string::npos; });
}

EglDevice device_of(const Egl& egl, const Api& api, Candidate candidate, int number) {
  const auto text = [&](Enum name) {
    const auto* found = api.GetString(name);
    return std::string(found == nullptr ? "unknown" : reinterpret_cast<const char*>(found));
  };
  EglDevice device{number, text(Api::kVendor), text(Api::kRenderer), text(Api::kVersion)};
  device.software = is_software(egl, candidate, device.renderer);
  device.memory_bytes = device.software ? 0 : memory_of(api);
  return device;
}

}  // namespace

Context::Context(const Egl& egl, Candidate candidate, int number) {
  device_.number = number;
  thread_ = std::thread([this, egl, candidate] { serve(egl, candidate); });
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return ready_; });
  if (failure_ == nullptr) return;
  lock.unlock();
  thread_.join();
  std::rethrow_exception(failure_);
}

Context::~Context() {
  {
    const std::scoped_lock lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Context::run(FunctionRef<void(Queue&)> task) {
  Job job{task};
  std::unique_lock lock(mutex_);
  jobs_.push_back(&job);
  changed_.notify_all();
  changed_.wait(lock, [&] { return job.done; });
  if (job.error != nullptr) std::rethrow_exception(job.error);
}

std::optional<StagingSlot> Context::staging_slot(std::size_t bytes) {
  if (!queue_->staging().possible()) return std::nullopt;
  const std::size_t whole = (bytes + kAligned - 1) / kAligned * kAligned;
  std::optional<StagingSlot> slot = queue_->staging().take(whole);
  if (!slot) run([&](Queue& queue) { slot = queue.staging().make(whole); });
  return slot;
}

std::size_t Context::max_bytes() const { return queue_->max_bytes(); }

void Context::serve(const Egl& egl, Candidate candidate) {
  const auto opened = [&](std::exception_ptr failure) {
    const std::scoped_lock lock(mutex_);
    failure_ = std::move(failure);
    ready_ = true;
    changed_.notify_all();
  };
  try {
    const Current current(egl, candidate);
    const Api api = load_api(egl);
    device_ = device_of(egl, api, candidate, device_.number);
    const std::string driver = device_.vendor + '\n' + device_.renderer + '\n' + device_.driver;
    Queue queue(api, device_, ProgramCache(ProgramCache::user_folder(), driver), kDebug != 0);
    queue_ = &queue;
    opened(nullptr);
    serve_jobs(queue);
  } catch (...) {
    opened(std::current_exception());
  }
}

void Context::serve_jobs(Queue& queue) {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return closing_ || !jobs_.empty(); });
    if (jobs_.empty()) return;
    Job& job = *jobs_.front();
    jobs_.pop_front();
    lock.unlock();
    try {
      job.task(queue);
    } catch (...) {
      job.error = std::current_exception();
    }
    lock.lock();
    job.done = true;
    changed_.notify_all();
  }
}

}  // namespace glint::gl
