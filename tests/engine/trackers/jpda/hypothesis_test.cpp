// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/jpda/hypothesis.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <vector>

namespace glint {
namespace {

AssociationHistory history(std::initializer_list<std::uint32_t> options) {
  AssociationHistory h;
  for (const std::uint32_t option : options) h.append(option);
  return h;
}

TEST(AssociationHistory, ForgetsTheOldestFirst) {
  AssociationHistory h = history({3, 5});
  h.keep_newest(1);
  EXPECT_EQ(h.scans(), 1);
  EXPECT_TRUE(h == history({5}));
  h.keep_newest(1);
  EXPECT_TRUE(h == history({5}));
  h.append(7);
  EXPECT_TRUE(h == history({5, 7}));
  h.keep_newest(0);
  EXPECT_TRUE(h == history({}));
}

TEST(AssociationHistory, DiffersByAnyScan) {
  EXPECT_TRUE(history({1, 2}) == history({1, 2}));
  EXPECT_FALSE(history({1, 2}) == history({1, 3}));
  EXPECT_FALSE(history({1, 2}) == history({3, 2}));
  EXPECT_FALSE(history({1}) == history({1, 0}));
}

// What is left in memory of a scan that was forgotten tells nothing apart.
TEST(AssociationHistory, DoesNotDifferByWhatItForgot) {
  AssociationHistory one = history({2, 4}), other = history({9, 4});
  one.keep_newest(1), other.keep_newest(1);
  EXPECT_TRUE(one == other);
}

TEST(NumberHistories, GivesLikeHistoriesOneNumber) {
  std::vector<Hypothesis<2>> hypotheses;
  for (const std::uint32_t option : {4, 0, 4, 2, 0}) hypotheses.push_back({history({option}), {}});
  std::vector<std::uint32_t> numbers;
  number_histories<2>(hypotheses, numbers);
  EXPECT_EQ(numbers, (std::vector<std::uint32_t>{0, 1, 0, 2, 1}));
}

TEST(NumberHistories, CountsEachTargetFromZero) {
  const std::vector<Hypothesis<2>> first{{history({1}), {}}, {history({1}), {}}};
  const std::vector<Hypothesis<2>> second{
      {history({5}), {}}, {history({6}), {}}, {history({6}), {}}};
  std::vector<std::uint32_t> numbers;
  number_histories<2>(first, numbers);
  number_histories<2>(second, numbers);
  EXPECT_EQ(numbers, (std::vector<std::uint32_t>{0, 0, 0, 1, 1}));
}

}  // namespace
}  // namespace glint
