// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

namespace glint {

/// Adds up the wall clock [s] that kernels took, by name, for those who ask a Device to keep it.
class KernelClock {
 public:
  template <class Run>
  void time(std::string_view kernel, const Run& run) {
    const auto start = std::chrono::steady_clock::now();
    run();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    const std::scoped_lock lock(mutex_);
    seconds_[std::string(kernel)] += taken.count();
  }
  std::map<std::string, double> seconds() const {
    const std::scoped_lock lock(mutex_);
    return seconds_;
  }
  void reset() {
    const std::scoped_lock lock(mutex_);
    seconds_.clear();
  }

 private:
  mutable std::mutex mutex_;
  std::map<std::string, double> seconds_;
};

}  // namespace glint
