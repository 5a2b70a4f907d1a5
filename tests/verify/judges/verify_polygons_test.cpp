// SPDX-License-Identifier: BSD-3-Clause
// Paths that touch polygons and walls, judged by counting squares: obstacles are unit squares (each a polygon of its
// own, so that they share sides and corners) and unit walls, paths go from grid point to grid point by straight and
// diagonal steps. Where such a path may go on around a grid point is a matter of its four squares.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "core/base/rng.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {
namespace {

constexpr int size = 6;
using Square = std::pair<int, int>;  // lower left corner
struct Place {
  int x, y;
  friend bool operator==(const Place&, const Place&) = default;
};

/// Squares and walls, some of them blocked.
class Board {
 public:
  Board(std::uint64_t seed, double squares, double walls) {
    for (int x = 0; x < size; ++x) {
      for (int y = 0; y < size; ++y) {
        const auto index = static_cast<std::uint64_t>(x * size + y);
        if (uniform(seed, index, 0) < squares) blocked_.insert({x, y});
        if (x > 0 && uniform(seed, index, 1) < walls) upright_.insert({x, y});  // left side of the square
        if (y > 0 && uniform(seed, index, 2) < walls) level_.insert({x, y});    // lower side
      }
    }
  }
  bool free(Square s) const {
    const bool on_board = s.first >= 0 && s.first < size && s.second >= 0 && s.second < size;
    return on_board && blocked_.count(s) == 0;
  }
  /// Sheared: (x, y) becomes (x + 2 y, y - x).
  Scene scene() const {
    Scene scene;
    for (const auto& [x, y] : blocked_) {
      scene.polygons.push_back({{at({x, y}), at({x + 1, y}), at({x + 1, y + 1}), at({x, y + 1})}, 0});
      if ((x + y) % 2 == 0) std::reverse(scene.polygons.back().corners.begin(), scene.polygons.back().corners.end());
    }
    // The board's rim: polygons around it, since bounds can't be sheared.
    const auto rim = [&](Place a, Place b, Place c, Place d) {
      scene.polygons.push_back({{at(a), at(b), at(c), at(d)}, 0});
    };
    rim({-1, -1}, {size + 1, -1}, {size + 1, 0}, {-1, 0});
    rim({-1, size}, {size + 1, size}, {size + 1, size + 1}, {-1, size + 1});
    rim({-1, 0}, {0, 0}, {0, size}, {-1, size});
    rim({size, 0}, {size + 1, 0}, {size + 1, size}, {size, size});
    std::vector<Segment> walls;
    for (const auto& [x, y] : upright_) walls.push_back({at({x, y}), at({x, y + 1})});
    for (const auto& [x, y] : level_) walls.push_back({at({x + 1, y}), at({x, y})});
    scene.walls = WallSet::narrowest(walls);
    return scene;
  }
  static Vec2 at(Place p) { return {static_cast<double>(p.x + 2 * p.y), static_cast<double>(p.y - p.x)}; }

  /// The squares around a grid point, anticlockwise from the upper right one.
  static std::array<Square, 4> around(Place p) {
    return {Square{p.x, p.y}, {p.x - 1, p.y}, {p.x - 1, p.y - 1}, {p.x, p.y - 1}};
  }
  /// Is there no wall between the i-th and the next square around p?
  bool open(Place p, std::size_t i) const {
    switch (i) {
      case 0:
        return upright_.count({p.x, p.y}) == 0;
      case 1:
        return level_.count({p.x - 1, p.y}) == 0;
      case 2:
        return upright_.count({p.x, p.y - 1}) == 0;
      default:
        return level_.count({p.x, p.y}) == 0;
    }
  }
  /// The free squares that a step lies in or runs along.
  std::vector<Square> beside(Place p, Place q) const {
    std::vector<Square> squares;
    const auto add = [&](Square s) {
      if (free(s)) squares.push_back(s);
    };
    const int x = std::min(p.x, q.x);
    const int y = std::min(p.y, q.y);
    add({x, y});
    if (p.x == q.x) add({x - 1, y});
    if (p.y == q.y) add({x, y - 1});
    return squares;
  }
  /// Those of `next` that can be reached around p from those of `from`.
  std::vector<Square> reached(Place p, const std::vector<Square>& from, const std::vector<Square>& next) const {
    const std::array<Square, 4> squares = around(p);
    std::array<bool, 4> seen{};
    for (std::size_t i = 0; i < 4; ++i) seen[i] = std::find(from.begin(), from.end(), squares[i]) != from.end();
    for (int pass = 0; pass < 4; ++pass) {
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t j = (i + 1) % 4;
        if (!open(p, i) || !free(squares[i]) || !free(squares[j])) continue;
        seen[i] = seen[j] = seen[i] || seen[j];
      }
    }
    std::vector<Square> result;
    for (const Square& s : next) {
      for (std::size_t i = 0; i < 4; ++i) {
        if (seen[i] && squares[i] == s) result.push_back(s);
      }
    }
    return result;
  }
  bool allowed(const std::vector<Place>& path) const {
    std::vector<Square> sides = beside(path[0], path[1]);
    for (std::size_t i = 1; i + 1 < path.size() && !sides.empty(); ++i) {
      sides = reached(path[i], sides, beside(path[i], path[i + 1]));
    }
    return !sides.empty();
  }
  bool untouched(const std::vector<Place>& path) const {
    for (const Place p : path) {
      for (std::size_t i = 0; i < 4; ++i) {
        if (!free(around(p)[i]) || !open(p, i)) return false;
      }
    }
    for (std::size_t i = 1; i < path.size(); ++i) {
      const bool diagonal = path[i - 1].x != path[i].x && path[i - 1].y != path[i].y;
      if (beside(path[i - 1], path[i]).size() < (diagonal ? 1U : 2U)) return false;
    }
    return true;  // a wall along a step touches the step's ends
  }

 private:
  std::set<Square> blocked_, upright_, level_;
};

std::vector<Place> walk(std::uint64_t seed, std::uint64_t number, std::size_t steps) {
  const auto die = [&](std::uint64_t axis, int sides) { return static_cast<int>(sides * uniform(seed, number, axis)); };
  std::vector<Place> path{{die(0, size + 1), die(1, size + 1)}};
  while (path.size() <= steps) {
    const std::uint64_t axis = 2 * path.size();
    const Place next{std::clamp(path.back().x + die(axis, 3) - 1, 0, size),
                     std::clamp(path.back().y + die(axis + 1, 3) - 1, 0, size)};
    if (next == path.back()) {
      path.push_back({path.back().x > 0 ? path.back().x - 1 : 1, path.back().y});
    } else {
      path.push_back(next);
    }
  }
  return path;
}

/// Points in the middle of a straight way are left out: legs of different lengths.
std::vector<Vec2> legs_of(const std::vector<Place>& path, bool merged) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const bool straight = i > 0 && i + 1 < path.size() && path[i].x - path[i - 1].x == path[i + 1].x - path[i].x &&
                          path[i].y - path[i - 1].y == path[i + 1].y - path[i].y;
    if (!merged || !straight) points.push_back(Board::at(path[i]));
  }
  return points;
}

TEST(VerifyPolygons, TouchingPathsAreJudgedAsTheSquaresAroundThemSay) {
  std::size_t allowed = 0;
  std::size_t refused = 0;
  std::size_t untouched = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Board board(seed, 0.1 * static_cast<double>(seed % 6), seed % 3 == 0 ? 0.0 : 0.15);
    const Scene scene = board.scene();
    for (std::uint64_t number = 0; number < 60; ++number) {
      SCOPED_TRACE(std::to_string(seed) + ": " + std::to_string(number));
      const std::vector<Place> path = walk(seed, number, 1 + number % 7);
      const std::vector<Vec2> points = legs_of(path, number % 2 == 0);
      const bool may = board.allowed(path);
      ASSERT_EQ(verify_path(scene, points, {.contact = Contact::allowed}, {}).verified, may);
      const bool off = board.untouched(path);
      ASSERT_EQ(verify_path(scene, points, {.contact = Contact::blocked}, {}).verified, off);
      ASSERT_TRUE(may || !off);
      (may ? allowed : refused) += 1;
      untouched += off ? 1 : 0;
    }
  }
  EXPECT_GT(allowed, 500U);
  EXPECT_GT(refused, 500U);
  EXPECT_GT(untouched, 100U);
}

Scene scene_of(std::vector<std::vector<Vec2>> polygons) {
  Scene scene;
  for (auto& corners : polygons) scene.polygons.push_back({std::move(corners), 0});
  scene.bounds = Box{{-10, -10}, {10, 10}};
  return scene;
}

bool allowed(const Scene& scene, std::vector<Vec2> path) {
  return verify_path(scene, path, {.contact = Contact::allowed}, {}).verified;
}

TEST(VerifyPolygons, ThroughACommonCornerIsRefusedAndAroundItAllowed) {
  const Scene scene = scene_of({{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {{2, 2}, {4, 2}, {4, 4}, {2, 4}}});
  EXPECT_FALSE(allowed(scene, {{1, 3}, {3, 1}}));
  EXPECT_FALSE(allowed(scene, {{1, 3}, {2, 2}, {3, 1}})) << "with a point of the path on the corner";
  EXPECT_FALSE(allowed(scene, {{0, 2}, {2, 2}, {2, 0}})) << "along both sides through it";
  EXPECT_TRUE(allowed(scene, {{0, 2}, {2, 2}, {2, 4}})) << "along two sides within one sector";
  EXPECT_TRUE(allowed(scene, {{1, 3}, {2, 2}, {1, 3}})) << "there and back";
  EXPECT_TRUE(allowed(scene, {{-1, 3}, {0, 2}, {0, 0}, {2, 0}, {4, 2}}));
}

TEST(VerifyPolygons, BetweenTwoPolygonsThatShareASideIsRefused) {
  const Scene scene = scene_of({{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {{2, 0}, {4, 0}, {4, 2}, {2, 2}}});
  EXPECT_FALSE(allowed(scene, {{2, -1}, {2, 3}}));
  EXPECT_FALSE(allowed(scene, {{2, 0}, {2, 2}}));
  EXPECT_FALSE(allowed(scene, {{2, 0.5}, {2, 1.5}}));
  EXPECT_TRUE(allowed(scene, {{0, 2}, {4, 2}})) << "over the end of the common side";
}

TEST(VerifyPolygons, ACornerMayBeTouchedFromItsFreeSideAlone) {
  const Scene arrow = scene_of({{{0, 0}, {4, -2}, {1, 0}, {4, 2}}});  // a notch at (1, 0)
  EXPECT_TRUE(allowed(arrow, {{5, 0}, {1, 0}, {5, 0.5}})) << "into the notch and out";
  EXPECT_FALSE(allowed(arrow, {{5, 0}, {1, 0}, {0, 0}})) << "through the body";
  EXPECT_FALSE(allowed(arrow, {{-1, 0}, {5, 0}}));
  EXPECT_TRUE(allowed(arrow, {{0, -3}, {0, 3}})) << "past the tip";
  EXPECT_TRUE(allowed(arrow, {{-1, 1}, {0, 0}, {-1, -1}}));
  EXPECT_TRUE(allowed(arrow, {{4, 2}, {1, 0}, {4, -2}})) << "along the notch";
  EXPECT_TRUE(allowed(arrow, {{0, 0}, {4, 2}})) << "along a side";
  EXPECT_FALSE(allowed(arrow, {{0, 0}, {1, 0}})) << "a diagonal inside";
}

TEST(VerifyPolygons, ADiscKeepsItsDistanceFromSidesAndCornersAndStaysOutside) {
  const Scene scene = scene_of({{{0, 0}, {2, 0}, {2, 2}, {0, 2}}});
  const auto free = [&](double r, std::vector<Vec2> path) {
    return verify_path(scene, path, {.clearance = r}, {}).verified;
  };
  EXPECT_TRUE(free(0.5, {{-0.5, -1}, {-0.5, 3}}));
  EXPECT_FALSE(free(0.5000001, {{-0.5, -1}, {-0.5, 3}}));
  EXPECT_TRUE(free(0.5, {{2.3, 2.5}, {2.5, 2.3}}));
  EXPECT_FALSE(free(0.1, {{1, 1}, {1.2, 1}})) << "inside";
  EXPECT_FALSE(free(0.5, {{9.6, 0}, {9.6, 1}})) << "the bounds are a wall";
}

}  // namespace
}  // namespace warren
