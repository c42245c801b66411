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
  /// Throws std::logic_error if part of the region lives there already.
  void add(const Region& kept, unsigned id, std::size_t capacity);
  /// The buffer of the region that begins there, which lives there no more; nothing if none does.
  std::optional<Place> remove(const std::byte* data);
  /// Nothing if the region lies elsewhere or is empty. Throws std::logic_error if it crosses a
  /// resident's edge or takes other rows of it.
  std::optional<Place> find(const Region& wanted) const;

 private:
  struct Resident {
    Region region;
    unsigned id;
    std::size_t capacity;
  };
  std::map<const std::byte*, Resident> residents_;
};

}  // namespace glint::gl
