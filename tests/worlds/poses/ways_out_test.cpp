// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/poses/car_world.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/worlds/poses/body_scenes.hpp"

namespace warren {
namespace {

using body_scenes::parking_bay;
using body_scenes::ParkingBay;

CarOptions options_of(const ParkingBay& bay, double scale) {
  return {.turning_radius = 3.0 * scale, .outline = bay.car};
}

TEST(WaysOut, LeadOutOfABayByFreeStrokesWhereverItLies) {
  struct Case {
    double scale;
    Vec2 origin;
  };
  for (const auto& [scale, origin] : {Case{1.0, {}}, Case{0.1, {-4e6, 3e5}}, Case{20.0, {1e5, 7.0}}}) {
    SCOPED_TRACE(scale);
    const ParkingBay bay = parking_bay(0.8, scale, origin);
    const CarBody body(bay.scene, options_of(bay, scale));
    auto query = body.make_query();
    const std::vector<Path<Se2>> ways = ways_out(body, bay.inside, 5, {});
    ASSERT_EQ(ways.size(), 5U);
    std::size_t fewest = 0;
    for (const Path<Se2>& way : ways) {
      EXPECT_EQ(way.front(), bay.inside);
      EXPECT_GE(way.size(), 5U) << "who needs fewer strokes is not held";
      EXPECT_GE(way.size(), fewest);
      fewest = way.size();
      for (std::size_t i = 1; i < way.size(); ++i) {
        const SteeringWord word = ReedsSheppCurve::shortest(way[i - 1], way[i], 3.0 * scale);
        EXPECT_LE(word.length, 0.8 * (1.0 + 1e-5));
        EXPECT_TRUE(body.is_free_curve({way[i - 1], way[i], word, 3.0 * scale}, query));
      }
      EXPECT_GT(norm(way.back().position() - bay.inside.position()), 0.3 * scale);
    }
  }
}

TEST(WaysOut, AreNoneWhereTheCarIsNotHeldOrCanNotLeave) {
  const ParkingBay bay = parking_bay(0.8);
  const CarBody body(bay.scene, options_of(bay, 1.0));
  EXPECT_TRUE(ways_out(body, bay.street, 5, {}).empty());
  const ParkingBay tight = parking_bay(0.02);
  EXPECT_TRUE(ways_out(CarBody(tight.scene, options_of(tight, 1.0)), tight.inside, 5, {}).empty());
}

TEST(WaysOut, EndWithTheTime) {
  const ParkingBay bay = parking_bay(0.8);
  const CarBody body(bay.scene, options_of(bay, 1.0));
  const Deadline over(0.0);
  Execution execution;
  execution.deadline = &over;
  EXPECT_THROW(ways_out(body, bay.inside, 5, execution), Stopped);
}

}  // namespace
}  // namespace warren
