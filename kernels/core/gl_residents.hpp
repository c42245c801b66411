// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <map>
#include <optional>

#include "glint/kernels/core/region.hpp"

namespace glint::gl {

/// Where a region lies on the device: rows follow each other without padding there.
struct Place {
  unsigned id;                   ///< the buffer
  std::size_t offset, capacity;  ///< of the region in it; of the whole buffer [bytes]
};

/// Regions of the host's memory that live on the device, by address.
class Residents {
 public:
  /// Whether the device is the only place of a region's bytes, or has a copy of them.
  enum class Home { only, copy };
  /// False, and nothing is added, if part of the region lives there already.
  bool add(const Region& added, Home home, unsigned id, std::size_t capacity);
  /// The buffer of the region that begins there, which lives there no more; nothing if none does.
  std::optional<Place> remove(const std::byte* data);
  /// Nothing if the region lies elsewhere or is empty. Throws std::logic_error if it crosses the
  /// edge of a resident that has its only home there, or takes other rows of it.
  std::optional<Place> find(const Region& wanted) const;

 private:
  struct Resident {
    Region region;
    Home home;
    unsigned id;
    std::size_t capacity;
  };
  std::map<const std::byte*, Resident> residents_;
};

}  // namespace glint::gl
