// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/number_text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace glint {
namespace {

std::string rounded(double x, int significant, int decimals) {
  std::string text = "x=";
  append_rounded(text, x, significant, decimals);
  return text.substr(2);
}

TEST(NumberText, IsTheShortestThatReadsBack) {
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(1e7), "1e7");
  EXPECT_EQ(number_text(2.5e-9), "2.5e-9");
  EXPECT_EQ(number_text(-std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(NumberText, RoundedKeepsAsManyDigitsAsAskedFor) {
  EXPECT_EQ(rounded(123.456789012, 8, 0), "123.45679");
  EXPECT_EQ(rounded(1.0 / 3, 9, 6), "0.333333333");
  EXPECT_EQ(rounded(1.5, 8, 3), "1.5");
  EXPECT_EQ(rounded(0, 8, 3), "0");
  EXPECT_EQ(rounded(1.25e-9, 8, 0), "1.25e-09");
  EXPECT_EQ(rounded(std::numeric_limits<double>::quiet_NaN(), 8, 3), "nan");
}

TEST(NumberText, RoundedKeepsTheDecimalsOfLargeNumbers) {
  EXPECT_EQ(rounded(10000000.01, 8, 3), "10000000.01");
  EXPECT_EQ(rounded(-10000000.0126, 8, 3), "-10000000.013");
  EXPECT_EQ(rounded(10000000.01, 8, 0), "10000000");
  EXPECT_EQ(rounded(2000000000.000001, 9, 6), "2000000000.000001");
  EXPECT_EQ(rounded(999999.9996, 8, 3), "1000000");
  EXPECT_EQ(rounded(1e300, 8, 3), "1.0000000000000001e+300");  // 17 digits, not 304
}

}  // namespace
}  // namespace glint
