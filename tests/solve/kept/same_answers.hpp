// SPDX-License-Identifier: BSD-3-Clause
// Two answers are the same in all but work and time.
#pragma once

#include <gtest/gtest.h>

#include "solve/answer/answer.hpp"

namespace warren::test {

inline void expect_same(const Answer& answer, const Answer& expected) {
  EXPECT_EQ(answer.outcome, expected.outcome);
  EXPECT_EQ(answer.verified, expected.verified);
  EXPECT_EQ(answer.optimal, expected.optimal);
  EXPECT_EQ(answer.length, expected.length);
  EXPECT_EQ(answer.min_clearance, expected.min_clearance);
  EXPECT_EQ(answer.path, expected.path);
  EXPECT_EQ(answer.states.numbers, expected.states.numbers);
  EXPECT_EQ(answer.counters.expanded, expected.counters.expanded);
  EXPECT_EQ(answer.roadmap.milestones, expected.roadmap.milestones);
  EXPECT_EQ(answer.planner, expected.planner);
  EXPECT_EQ(answer.pipeline, expected.pipeline);
  EXPECT_EQ(answer.search, expected.search);
  EXPECT_EQ(answer.world.hash, expected.world.hash);
  EXPECT_EQ(answer.path_figures.size(), expected.path_figures.size());
}

}  // namespace warren::test
