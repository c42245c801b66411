// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/number_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace glint {

void append_number(std::string& out, double x) {
  if (std::isnan(x)) {
    out += "nan";  // to_chars would show the sign of a NaN, which means nothing
    return;
  }
  char buffer[32];
  const std::to_chars_result end = std::to_chars(buffer, buffer + sizeof buffer, x);
  const std::string_view text(buffer, static_cast<std::size_t>(end.ptr - buffer));
  const std::size_t e = text.find('e');
  out += text.substr(0, e);
  if (e == std::string_view::npos) return;
  out += 'e';
  if (text[e + 1] == '-') out += '-';
  out += text.substr(text.find_first_not_of("+-0", e + 1));
}

void append_rounded(std::string& out, double x, int significant, int decimals) {
  if (!std::isfinite(x) || x == 0) return append_number(out, x);
  const int before = static_cast<int>(std::floor(std::log10(std::abs(x)))) + 1;
  const int digits = std::min(std::max(significant, before + decimals), 17);
  char buffer[32];
  const std::to_chars_result end =
      std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::general, digits);
  out.append(buffer, end.ptr);
}

std::string number_text(double x) {
  std::string text;
  append_number(text, x);
  return text;
}

std::string in_quotes(std::string_view text) {
  static constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string out = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += {'\\', c};
    } else if (code < 0x20 || code == 0x7f) {
      out += {'\\', 'u', '0', '0', kHex[code / 16], kHex[code % 16]};
    } else {
      out += c;
    }
  }
  return out + '"';
}

}  // namespace glint
