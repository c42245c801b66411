// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

#include "glint/engine/config.hpp"

namespace glint {

/// An Entry of a list of scenes for the settings C: C::kName, their defaults, and make_scene(C).
template <class Entry, class C>
constexpr Entry scene_entry(std::string_view summary) {
  return {C::kName, summary, [] { return ConfigSection::of<C>("scenes." + std::string(C::kName)); },
          [](const ConfigSection& section) { return make_scene(section.as<C>()); }};
}

}  // namespace glint
