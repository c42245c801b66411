// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/resident_particles.hpp"

#include "glint/engine/state/fields.hpp"

namespace glint {

void ResidentParticles::put_to(ByteWriter& to) const {
  fetch();
  put_bytes(to, arrays_);
}

void ResidentParticles::take_from(ByteReader& from) {
  Particles read;
  take_bytes(from, read);
  read.for_each_array([&](const auto& values) {
    require_bytes(values.size() == read.size(), "arrays of particles do not fit each other");
  });
  resize(read.size());  // then this copies to where the arrays are
  arrays_ = read;
  arrays_.for_each_array([&](auto& values) { device_.send(std::span(values)); });
}

}  // namespace glint
