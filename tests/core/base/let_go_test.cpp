// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/raw_vector.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace warren {
namespace {

TEST(LetGo, LeavesNoRoom) {
  std::vector<int> numbers(100, 1);
  RawVector<double> raw(100);
  std::vector<std::vector<int>> lists(3, numbers);
  let_go(numbers, raw, lists);
  EXPECT_EQ(numbers.capacity() + raw.capacity() + lists.capacity(), 0U);
  EXPECT_TRUE(numbers.empty() && raw.empty() && lists.empty());
}

}  // namespace
}  // namespace warren
