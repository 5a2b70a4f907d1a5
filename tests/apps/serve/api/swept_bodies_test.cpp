// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/api/kept_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/error.hpp"

namespace warren::serve {
namespace {

constexpr double far = std::numeric_limits<double>::infinity();
const PathView whole_view{.box = {{-far, -far}, {far, far}}};

Answer way_of(RobotSpec robot, std::vector<double> states = {}) {
  Answer way;
  way.problem.robot = std::move(robot);
  if (!states.empty()) way.states = {.width = 3, .numbers = std::move(states)};
  return way;
}

const RobotSpec disc{.kind = RobotKind::disc, .radius = 1.0};

TEST(SweptBodies, DiscsAreHalfARadiusApartWithBothEnds) {
  const KeptCurve curve({{0, 0}, {3, 0}, {3, 2.2}}, {});
  const SweptBodies bodies = swept_bodies(way_of(disc), curve, whole_view, {});
  EXPECT_EQ(bodies.apart, 0.5);
  ASSERT_EQ(bodies.places.size(), 12U);
  EXPECT_EQ(bodies.places[0].numbers[0], 0.0);
  EXPECT_EQ(bodies.places[3].numbers[0], 1.5);
  EXPECT_NEAR(bodies.places[7].numbers[1], 0.5, 1e-12);
  EXPECT_EQ(bodies.places[11].numbers[1], 2.2);
}

TEST(SweptBodies, APathOfOnePlaceHasOneBody) {
  const auto bodies = swept_bodies(way_of(disc), KeptCurve({{7, 8}}, {}), whole_view, {});
  ASSERT_EQ(bodies.places.size(), 1U);
  EXPECT_EQ(bodies.places[0].numbers[1], 8.0);
}

TEST(SweptBodies, AWindowOfALongWayCostsWhatItShows) {
  const KeptCurve curve({{0, 0}, {1e12, 0}}, {});
  const PathView view{.box = {{5e11, -10}, {5e11 + 20, 10}}};
  const SweptBodies bodies = swept_bodies(way_of(disc), curve, view, {});
  EXPECT_EQ(bodies.apart, 0.5);
  EXPECT_NEAR(static_cast<double>(bodies.places.size()), 45.0, 1.0);
  for (const PathState& place : bodies.places) EXPECT_NEAR(place.numbers[0], 5e11 + 10, 11.001);
}

TEST(SweptBodies, ManyAreFartherApart) {
  Path<Vec2> path;
  for (int i = 0; i < 100'000; ++i) path.push_back({static_cast<double>(i % 2), 0.01 * i});
  const KeptCurve curve(path, {});
  const SweptBodies bodies = swept_bodies(way_of(disc), curve, whole_view, {});
  EXPECT_GT(bodies.places.size(), most_swept_bodies / 3);
  EXPECT_LE(bodies.places.size(), most_swept_bodies);
  const double pixel = 30.0;
  EXPECT_GE(swept_bodies(way_of(disc), curve, {.box = whole_view.box, .pixel = pixel}, {}).apart, 12 * pixel);
}

TEST(SweptBodies, StandWhereTheyStoodWhenLessIsInSight) {
  for (const double step : {1.0, 0.7}) {  // over a lattice and elsewhere
    SCOPED_TRACE(step);
    Path<Vec2> path{{0.5, 1.0}};
    while (path.size() < 3 * KeptCurve::block_points) path.push_back({step * static_cast<double>(path.size()), 1.0});
    const KeptCurve curve(path, {});
    const Answer way = way_of({.kind = RobotKind::disc, .radius = 50.0});
    const SweptBodies all = swept_bodies(way, curve, whole_view, {});
    const double middle = step * (2.5 * KeptCurve::block_points);
    const SweptBodies some = swept_bodies(way, curve, {.box = {{middle, 0}, {middle + 500, 2}}}, {});
    for (std::size_t i = 1; i + 1 < all.places.size(); ++i) {
      ASSERT_NEAR(all.places[i].numbers[0] - all.places[i - 1].numbers[0], all.apart, 1e-8) << i;
    }
    ASSERT_EQ(some.apart, all.apart);
    ASSERT_NEAR(static_cast<double>(some.places.size()), 600.0 / all.apart, 1.0);
    for (const PathState& place : some.places) {
      EXPECT_TRUE(std::ranges::any_of(all.places, [&](const PathState& p) { return p.numbers == place.numbers; }))
          << place.numbers[0];
    }
  }
}

TEST(SweptBodies, TurnsOnTheSpotAreSeen) {
  const RobotSpec bar{.kind = RobotKind::polygon, .outline = {{-2, -0.1}, {2, -0.1}, {0, 0.1}}};
  const auto bodies = swept_bodies(way_of(bar, {0, 0, 0, 0, 0, 3.0}), KeptCurve({{0, 0}, {0, 0}}, {}), whole_view, {});
  ASSERT_EQ(bodies.places.size(), 7U);
  EXPECT_NEAR(bodies.places[2].numbers[2], 2.0 * bodies.apart / reach_of(bar), 1e-12);
  EXPECT_EQ(bodies.places[6].numbers[2], 3.0);
}

TEST(SweptBodies, CarsAreOnTheirArcs) {
  const RobotSpec car{.kind = RobotKind::car, .radius = 0.2, .turning_radius = 1.0};
  const double pi = std::numbers::pi;
  const auto bodies =
      swept_bodies(way_of(car, {1, 0, pi / 2, -1, 0, 3 * pi / 2}), KeptCurve({{1, 0}, {-1, 0}}, {}), whole_view, {});
  EXPECT_GT(bodies.places.size(), 25U);
  for (const PathState& place : bodies.places) {
    EXPECT_NEAR(std::hypot(place.numbers[0], place.numbers[1]), 1.0, 1e-9);
  }
}

TEST(SweptBodies, APointHasNone) {
  EXPECT_THROW(swept_bodies(way_of({}), KeptCurve({{0, 0}, {1, 1}}, {}), whole_view, {}), UsageError);
}

}  // namespace
}  // namespace warren::serve
