// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/contest_pictures.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace warren::studies {
namespace {

double length_of(const PolygonSet& lines) {
  double length = 0.0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t k = 1; k < lines[i].size(); ++k) length += distance(lines[i][k - 1], lines[i][k]);
  }
  return length;
}

TEST(LinesSideBySide, APathAloneIsOneLine) {
  const std::vector<std::vector<Vec2>> paths{{{0, 0}, {1, 0}, {1, 1}}};
  const auto lines = lines_side_by_side(paths, 0.1, {});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].size(), 1U);
  EXPECT_EQ(lines[0].corners, paths[0]);
}

TEST(LinesSideBySide, EqualPathsTakeTurnsInEitherDirection) {
  const std::vector<std::vector<Vec2>> paths{{{0, 0}, {3, 0}, {3, 3}}, {{3, 3}, {3, 0}, {0, 0}}};
  const auto lines = lines_side_by_side(paths, 0.5, {});
  EXPECT_EQ(lines[0].size(), 6U);
  EXPECT_EQ(lines[1].size(), 6U);
  EXPECT_NEAR(length_of(lines[0]), 3.0, 1e-12) << "half of it each";
  EXPECT_NEAR(length_of(lines[1]), 3.0, 1e-12);
  EXPECT_EQ(lines[0].corners.front(), (Vec2{0, 0}));
  EXPECT_EQ(lines[1].corners.back(), (Vec2{3, 3}));
}

TEST(LinesSideBySide, WhatIsSharedByAllIsShownOfAllAndTheRestWhole) {
  // The first leg is everybody's, the second that of two, the last ones differ.
  const std::vector<std::vector<Vec2>> paths{
      {{0, 0}, {6, 0}, {8, 0}, {8, 1}}, {{0, 0}, {6, 0}, {8, 0}, {8, -1}}, {{0, 0}, {6, 0}, {6, 5}}};
  const auto lines = lines_side_by_side(paths, 1.0, {});
  EXPECT_NEAR(length_of(lines[0]), 2.0 + 1.0 + 1.0, 1e-12);
  EXPECT_NEAR(length_of(lines[1]), 2.0 + 1.0 + 1.0, 1e-12);
  EXPECT_NEAR(length_of(lines[2]), 2.0 + 5.0, 1e-12);
}

TEST(LinesSideBySide, OverlappingLegsWithOtherCornersTakeTurnsWhereTheyOverlap) {
  const Vec2 along[] = {{3, 0}, {0, 3}, {3, 1}, {-3, 7}};
  for (const Vec2 leg : along) {
    // From 0 to 3 legs, from 1 to 4 with a corner at 2, and from 4 back to 2: shared are 1 to 3, and 2 to 4.
    const auto at = [&](double k) { return Vec2{0.1, 0.7} + k * leg; };
    const std::vector<std::vector<Vec2>> paths{{at(0), at(3)}, {at(1), at(2), at(4)}, {at(4), at(2)}};
    const auto lines = lines_side_by_side(paths, 0.05 * norm(leg), {});
    EXPECT_NEAR(length_of(lines[0]) / norm(leg), 1.0 + 1.0 / 2.0 + 1.0 / 3.0, 1e-3);
    EXPECT_NEAR(length_of(lines[1]) / norm(leg), 1.0 / 2.0 + 1.0 / 3.0 + 1.0 / 2.0, 1e-3);
    EXPECT_NEAR(length_of(lines[2]) / norm(leg), 1.0 / 3.0 + 1.0 / 2.0, 1e-3);
  }
}

TEST(LinesSideBySide, PathsThatDifferByLessThanIsSeenTakeTurns) {
  const double off = 1.6e-6;
  const std::vector<std::vector<Vec2>> paths{{{1, 1}, {4, 2}, {5, 5}, {9, 6}}, {{1, 1}, {4 + off, 2 - off}, {9, 6}}};
  const std::vector<std::vector<Vec2>> taut{paths[0], {{1, 1}, {4 + off, 2 - off}, {5 - off, 5 + off}, {9, 6}}};
  const auto lines = lines_side_by_side(taut, 0.1, {});
  EXPECT_NEAR(length_of(lines[0]), length_of(lines[1]), 1e-3);
  const auto other = lines_side_by_side(paths, 0.1, {});
  EXPECT_GT(length_of(other[0]), 1.5 * std::sqrt(10.0)) << "only the first leg is shared";
}

TEST(LinesSideBySide, PathsThatCrossShareNothing) {
  const std::vector<std::vector<Vec2>> paths{{{0, 0}, {4, 4}}, {{0, 4}, {2, 2}, {4, 0}}, {{2, 2}, {2, 5}}};
  const auto lines = lines_side_by_side(paths, 0.1, {});
  EXPECT_NEAR(length_of(lines[0]), std::sqrt(32.0), 1e-12);
  EXPECT_NEAR(length_of(lines[1]), std::sqrt(32.0), 1e-12);
  EXPECT_NEAR(length_of(lines[2]), 3.0, 1e-12);
}

TEST(LinesSideBySide, ShortAndDegeneratePartsStillShowAll) {
  const std::vector<std::vector<Vec2>> paths{
      {{0, 0}, {0, 0}, {1, 0}}, {{0, 0}, {1, 0}}, {{1, 0}, {0, 0}}, {}, {{5, 5}}};
  const auto lines = lines_side_by_side(paths, 100.0, {});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(length_of(lines[i]), 1.0 / 3.0, 1e-12) << i;
  EXPECT_TRUE(lines[3].empty());
  EXPECT_TRUE(lines[4].empty());
}

}  // namespace
}  // namespace warren::studies
