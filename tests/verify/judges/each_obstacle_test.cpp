// SPDX-License-Identifier: BSD-3-Clause
// A judge that overlooks one place would pass nearly every world that is drawn at random. So obstacles stand on a grid,
// and paths are judged that meet one of them alone, each in its turn.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "verify/judges/verify_point.hpp"
#include "verify/judges/verify_turning.hpp"

namespace warren {
namespace {

constexpr int columns = 12;
constexpr int rows = 9;

/// Calls check(x, y), the middle of each cell.
template <class Check>
void for_each_cell(const Check& check) {
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      SCOPED_TRACE(std::to_string(x) + " " + std::to_string(y));
      check(x + 0.5, y + 0.5);
    }
  }
}

Scene with_bounds() {
  Scene scene;
  scene.bounds = Box{{-1, -1}, {columns + 1, rows + 1}};
  return scene;
}

TEST(Judges, EachCellOfAMapStandsInTheWay) {
  for_each_cell([](double x, double y) {
    OccupancyMap map;
    map.blocked = Bitmap(columns, rows);
    const auto is_free = [&](const std::vector<Vec2>& path, double clearance) {
      return verify_on_map(map, path, {.clearance = clearance}, {}).verified;
    };
    const std::vector<Vec2> level{{0.5, y}, {columns - 0.5, y}};
    const std::vector<Vec2> upright{{x, 0.5}, {x, rows - 0.5}};
    EXPECT_TRUE(is_free(level, 0.0) && is_free(upright, 0.3));
    map.blocked.set(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
    EXPECT_FALSE(is_free(level, 0.0));
    EXPECT_FALSE(is_free(upright, 0.3));
    EXPECT_FALSE(is_free({{x, y}}, 0.0));
  });
}

TEST(Judges, EachWallStandsInTheWayOfPointsAndDiscs) {
  Scene scene = with_bounds();
  std::vector<Segment> walls;
  for_each_cell([&](double x, double y) { walls.push_back({{x - 0.2, y - 0.1}, {x + 0.2, y + 0.1}}); });
  scene.walls = WallSet::narrowest(walls);
  for_each_cell([&](double x, double y) {
    const auto is_free = [&](double from, double to, double clearance) {
      return verify_path(scene, std::vector<Vec2>{{x, y + from}, {x, y + to}}, {.clearance = clearance}, {}).verified;
    };
    EXPECT_TRUE(is_free(0.2, 0.5, 0.1));
    EXPECT_FALSE(is_free(-0.4, 0.4, 0.0));
    EXPECT_FALSE(is_free(0.2, 0.5, 0.3));
  });
}

TEST(Judges, EachPolygonStandsInTheWayOfPointsTurningBodiesAndCars) {
  Scene scene = with_bounds();
  for_each_cell([&](double x, double y) {
    scene.polygons.push_back({{{x - 0.2, y - 0.2}, {x + 0.2, y - 0.2}, {x, y + 0.2}}});
  });
  const std::vector<Vec2> bar{{-0.1, -0.05}, {0.1, -0.05}, {0.1, 0.05}, {-0.1, 0.05}};
  const RobotSpec car{.kind = RobotKind::car, .turning_radius = 0.3, .outline = bar};
  for_each_cell([&](double x, double y) {
    const auto as_point = [&](double to) {
      return verify_path(scene, std::vector<Vec2>{{x - 0.4, y}, {x + to, y}}, {}, {}).verified;
    };
    const auto as_body = [&](double to) {
      return verify_se2(scene, bar, std::vector<Se2>{{x - 0.4, y, 0}, {x + to, y, 0}}, {}, {}).verified;
    };
    const auto as_car = [&](double to) {
      return verify_car(scene, car, std::vector<Se2>{{x - 0.4, y, 0}, {x + to, y, 0}}, {}, {}).verified;
    };
    EXPECT_TRUE(as_point(-0.3) && as_body(-0.3) && as_car(-0.3));
    EXPECT_FALSE(as_point(0.4));
    EXPECT_FALSE(as_body(0.4));
    EXPECT_FALSE(as_car(0.4));
  });
}

}  // namespace
}  // namespace warren
