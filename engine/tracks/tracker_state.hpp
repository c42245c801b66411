// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "glint/engine/state/fields.hpp"
#include "glint/engine/tracks/tracker.hpp"

namespace glint {

template <class T>
void TrackerOf<T>::save(ByteWriter& to) const {
  put_bytes(to, static_cast<const T&>(*this));
}

template <class T>
void TrackerOf<T>::restore(ByteReader& from) {
  take_bytes(from, static_cast<T&>(*this));
}

}  // namespace glint
