// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "glint/frontends/usage_error.hpp"

namespace glint {

/// What a file holds, by its name.
enum class InputKind { image, tiff, video, fits, npy, points };

/// Throws UsageError that lists the known extensions if it is none of them.
InputKind kind_of(std::string_view path);

/// "f_9.png" before "f_10.png": runs of digits compare as numbers, the rest as bytes.
bool natural_less(std::string_view a, std::string_view b);

/// The files behind `inputs`, in order. Each input is a file; a folder, which stands for the frames
/// in it in natural order (all of one extension, other files are passed over); or a printf pattern
/// such as "f_%04d.png", which stands for all files that match, by number. Gaps in the numbers are
/// warned of. Throws UsageError for missing files and for folders and patterns without frames.
std::vector<std::string> expand_inputs(std::span<const std::string> inputs, const Warn& warn);

}  // namespace glint
