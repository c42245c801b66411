// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/gl_residents.hpp"

#include <functional>
#include <stdexcept>

namespace glint::gl {
namespace {

/// The first byte behind the region.
const std::byte* end_of(const Region& region) {
  const auto rows_before = static_cast<std::ptrdiff_t>(region.rows) - 1;
  return region.data + rows_before * region.pitch + region.row_bytes;
}

bool before(const std::byte* a, const std::byte* b) { return std::less<>()(a, b); }

/// Offset of `part` among the bytes of `whole`; nothing if it is no run of whole rows, or of bytes
/// where there is but one row.
std::optional<std::size_t> offset_in(const Region& whole, const Region& part) {
  const std::ptrdiff_t ahead = part.data - whole.data;
  if (before(end_of(whole), end_of(part))) return std::nullopt;
  if (whole.rows == 1) {
    if (part.rows != 1) return std::nullopt;
    return static_cast<std::size_t>(ahead);
  }
  const bool same_rows = part.row_bytes == whole.row_bytes && ahead % whole.pitch == 0 &&
                         (part.rows == 1 || part.pitch == whole.pitch);
  if (!same_rows) return std::nullopt;
  return static_cast<std::size_t>(ahead / whole.pitch) * whole.row_bytes;
}

}  // namespace

bool Residents::add(const Region& added, Home home, unsigned id, std::size_t capacity) {
  const Region region = added.flat();
  const auto next = residents_.lower_bound(region.data);
  if (next != residents_.end() && before(next->first, end_of(region))) return false;
  if (next != residents_.begin() && before(region.data, end_of(std::prev(next)->second.region))) {
    return false;
  }
  residents_.emplace(region.data, Resident{region, home, id, capacity});
  return true;
}

std::optional<Place> Residents::remove(const std::byte* data) {
  const auto found = residents_.find(data);
  if (found == residents_.end()) return std::nullopt;
  const Place place{found->second.id, 0, found->second.capacity};
  residents_.erase(found);
  return place;
}

std::optional<Place> Residents::find(const Region& wanted) const {
  const Region region = wanted.flat();
  const auto next = residents_.upper_bound(region.data);
  if (next == residents_.begin() || region.bytes() == 0) return std::nullopt;
  const Resident& resident = std::prev(next)->second;
  if (!before(region.data, end_of(resident.region))) return std::nullopt;
  const auto offset = offset_in(resident.region, region);
  if (!offset) {
    if (resident.home == Home::copy) return std::nullopt;
    throw std::logic_error("memory resident on the device is used in another shape");
  }
  return Place{resident.id, *offset, resident.capacity};
}

}  // namespace glint::gl
