// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/embed/child.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <system_error>

namespace glint::bench {
namespace {

std::span<const std::byte> bytes(const std::string& text) { return std::as_bytes(std::span(text)); }

TEST(Child, IsWrittenToAndRead) {
  Child cat({"cat"}, Child::Output::read);
  cat.write(bytes("one\ntwo\n"));
  EXPECT_EQ(cat.line(), "one");
  EXPECT_EQ(cat.line(), "two");
  EXPECT_EQ(cat.wait(), 0);
  EXPECT_EQ(cat.line(), std::nullopt);
}

TEST(Child, TellsHowItEnded) {
  EXPECT_EQ(Child({"sh", "-c", "exit 3"}, Child::Output::dropped).wait(), 3);
  EXPECT_EQ(Child({"sh", "-c", "kill -9 $$"}, Child::Output::dropped).wait(), 128 + 9);
}

TEST(Child, OneThatIsNotThereIsAnError) {
  EXPECT_THROW(Child({"/no/such/program"}, Child::Output::dropped), std::system_error);
}

TEST(Child, OneThatReadsNoMoreIsAnErrorAndNotTheEndOfThisProgram) {
  Child gone({"sh", "-c", "exec <&-; echo closed"}, Child::Output::read);
  EXPECT_EQ(gone.line(), "closed");
  EXPECT_THROW(gone.write(bytes("anybody?")), std::runtime_error);
}

}  // namespace
}  // namespace glint::bench
