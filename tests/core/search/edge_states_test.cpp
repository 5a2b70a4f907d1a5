// SPDX-License-Identifier: BSD-3-Clause
#include "core/search/graph.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace warren {
namespace {

TEST(EdgeStates, EachEndKeepsItsOwn) {
  constexpr std::size_t ends = 71;
  std::vector<std::uint64_t> words(edge_state_words(ends));
  ASSERT_EQ(words.size(), 3U);
  const auto wanted = [](std::size_t end) { return static_cast<EdgeState>(end * 7 % 3); };
  for (std::size_t end = 0; end < ends; ++end) set_edge_state(words, end, EdgeState::blocked);
  for (std::size_t end = 0; end < ends; ++end) set_edge_state(words, end, wanted(end));
  for (std::size_t end = 0; end < ends; ++end) EXPECT_EQ(edge_state(words, end), wanted(end)) << end;
  EXPECT_EQ(words.back() >> (2 * (ends % edge_states_in_word)), 0U);
}

}  // namespace
}  // namespace warren
