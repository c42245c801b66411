// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

namespace glint {

/// The shortest text that reads back as `x`, with exponents as people write them: 1e7, not 1e+07;
/// "nan" for every NaN. Does not depend on the locale.
std::string number_text(double x);
/// Appends number_text(x).
void append_number(std::string& out, double x);
/// Appends `x` to `significant` digits, or to more if it takes them for `decimals` behind the
/// point, but no more than the 17 that a double has; zeros at the end are left out. "nan" for every
/// NaN.
void append_rounded(std::string& out, double x, int significant, int decimals);
/// `text` as a TOML basic string, quotes included.
std::string in_quotes(std::string_view text);

}  // namespace glint
