// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <utility>

#include "glint/engine/scheduler.hpp"
#include "glint/frontends/capi/glint.h"

namespace glint::capi {

/// Tells the caller when nobody reads the pixels any more, unless they stayed the caller's.
class Lease {
 public:
  Lease(void (*release)(void*), void* user, std::shared_ptr<const void> copy)
      : release_(release), user_(user), copy_(std::move(copy)) {}
  Lease(const Lease&) = delete;
  Lease& operator=(const Lease&) = delete;
  ~Lease() {
    if (release_ != nullptr) release_(user_);
  }
  void keep() { release_ = nullptr; }

 private:
  void (*release_)(void*);
  void* user_;
  std::shared_ptr<const void> copy_;
};

/// The frame as the engine takes it: the caller's own pixels if it has a release() and they are
/// aligned, else a copy. Throws BadArgument.
SourceFrame source_frame(glint_frame frame);

}  // namespace glint::capi
