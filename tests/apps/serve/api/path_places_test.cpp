// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/api/kept_path.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace warren::serve {
namespace {

TEST(PathPlaces, AreEvenlyApartWithBothEnds) {
  Answer answer;
  answer.path = {{0, 0}, {3, 0}, {3, 0}, {3, 5}};
  const auto places = places_along(answer, 5, {});
  ASSERT_EQ(places.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_DOUBLE_EQ(places[i].along, 2.0 * static_cast<double>(i));
    EXPECT_EQ(places[i].state.width, 2U);
  }
  EXPECT_EQ(places[1].state.numbers[0], 2.0);
  EXPECT_EQ(places[2].state.numbers[1], 1.0);
  EXPECT_EQ(places[4].state.numbers[1], 5.0);
}

TEST(PathPlaces, APathOfOneStateHasOne) {
  Answer answer;
  answer.path = {{7, 8}};
  EXPECT_EQ(places_along(answer, 9, {}).size(), 1U);
  answer.states = {.width = 3, .numbers = {7, 8, 0.5}};
  const auto places = places_along(answer, 9, {});
  ASSERT_EQ(places.size(), 1U);
  EXPECT_EQ(places[0].state.numbers[2], 0.5);
  EXPECT_EQ(places[0].along, 0.0);
}

TEST(PathPlaces, TurnsOnTheSpotAreSeenAndHaveNoWay) {
  Answer answer;
  answer.problem.robot = {.kind = RobotKind::polygon, .outline = {{-1, -1}, {1, -1}, {0, 2}}};
  answer.states = {.width = 3, .numbers = {0, 0, 0, 0, 0, 1.0, 2, 0, 1.0}};  // turns 1 rad at reach 2, then goes 2
  answer.path = {{0, 0}, {0, 0}, {2, 0}};
  const auto places = places_along(answer, 5, {});
  EXPECT_DOUBLE_EQ(places[1].state.numbers[2], 0.5);
  EXPECT_DOUBLE_EQ(places[2].along, 0.0);
  EXPECT_DOUBLE_EQ(places[3].along, 1.0);
  EXPECT_DOUBLE_EQ(places[4].state.numbers[0], 2.0);
}

TEST(PathPlaces, ACarsAreOnItsArcs) {
  Answer answer;
  answer.problem.robot = {.kind = RobotKind::car, .turning_radius = 1.0};
  answer.states = {.width = 3, .numbers = {1, 0, std::numbers::pi / 2, -1, 0, 3 * std::numbers::pi / 2}};
  answer.path = {{1, 0}, {-1, 0}};
  const auto places = places_along(answer, 3, {});
  EXPECT_NEAR(places[1].state.numbers[0], 0.0, 1e-12);
  EXPECT_NEAR(places[1].state.numbers[1], 1.0, 1e-12);
  EXPECT_NEAR(places[2].along, std::numbers::pi, 1e-12);
}

}  // namespace
}  // namespace warren::serve
