// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/once.hpp"

#include <gtest/gtest.h>

#include "parallel/chunks.hpp"

namespace warren {
namespace {

TEST(LastingMarks, AreSetOneByOne) {
  LastingMarks marks(130);
  for (const std::size_t i : {0U, 63U, 64U, 129U}) marks.set(i);
  marks.set(64);
  for (std::size_t i = 0; i < 130; ++i) EXPECT_EQ(marks.test(i), i == 0 || i == 63 || i == 64 || i == 129) << i;
}

TEST(LastingMarks, LoseNoneThatThreadsSetAtOnce) {
  constexpr std::size_t n = 10'000;
  LastingMarks marks(n);
  for_chunks(n, 1, {.threads = 8}, [&](Range r) { marks.set(n - 1 - r.first); });
  std::size_t set = 0;
  for (std::size_t i = 0; i < n; ++i) set += marks.test(i) ? 1U : 0U;
  EXPECT_EQ(set, n);
}

}  // namespace
}  // namespace warren
