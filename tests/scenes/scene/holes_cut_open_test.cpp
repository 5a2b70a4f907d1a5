// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/scene/plane_obstacles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/polygon.hpp"

namespace warren {
namespace {

using Ring = std::vector<Vec2>;

Ring star(std::uint64_t seed, std::uint64_t number, Vec2 center, double reach, int corners) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const auto index = number * 100 + static_cast<std::uint64_t>(i);
    const double angle = 2.0 * std::numbers::pi * (i + 0.7 * uniform(seed, index, 0)) / corners;
    const double r = reach * (0.4 + 0.6 * uniform(seed, index, 1));
    ring.push_back({center.x + r * std::cos(angle), center.y + r * std::sin(angle)});
  }
  return ring;
}

double area(const Ring& ring) {
  double doubled = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) doubled += cross(ring[i], ring[(i + 1) % ring.size()]);
  return doubled / 2;
}

/// The pieces are simple, touch at most, and cover the polygon but for its holes.
void check_pieces(const Ring& outer, const std::vector<Ring>& holes, std::uint64_t seed) {
  const std::vector<Ring> pieces = without_holes(outer, holes, {});
  ASSERT_FALSE(pieces.empty());
  Scene scene;
  double covered = 0.0;
  for (const Ring& piece : pieces) {
    scene.polygons.push_back({piece, 1});
    covered += area(piece);
  }
  EXPECT_NO_THROW(plane_obstacles(scene, {}));
  double expected = std::abs(area(outer));
  for (const Ring& hole : holes) expected -= std::abs(area(hole));
  EXPECT_NEAR(covered, expected, 1e-9);
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Vec2 p{12.0 * uniform(seed, i, 5) - 1.0, 12.0 * uniform(seed, i, 6) - 1.0};
    bool solid = contains(outer, p);
    for (const Ring& hole : holes) solid = solid && !contains(hole, p);
    int in = 0;
    for (const Ring& piece : pieces) in += contains(piece, p) ? 1 : 0;
    EXPECT_EQ(in, solid ? 1 : 0) << p.x << ' ' << p.y;
  }
}

TEST(PolygonHoles, PiecesCoverThePolygonButNotItsHoles) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Ring outer{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    std::vector<Ring> holes;
    for (std::uint64_t cell = 0; cell < 9; ++cell) {
      if (uniform(seed, cell, 9) < 0.3) continue;
      const Vec2 center{2.0 + 3.0 * static_cast<double>(cell % 3), 2.0 + 3.0 * static_cast<double>(cell / 3)};
      holes.push_back(star(seed, cell, center, 1.4, 3 + static_cast<int>(cell % 5)));
      if (cell % 2 == 0) std::reverse(holes.back().begin(), holes.back().end());
    }
    if (seed % 2 == 0) std::reverse(outer.begin(), outer.end());
    check_pieces(outer, holes, seed);
  }
}

TEST(PolygonHoles, SquaresInARowAndAboveEachOtherAreCutToo) {
  std::vector<Ring> holes;
  for (const double x : {1.0, 4.0, 7.0}) {
    for (const double y : {1.0, 4.0, 7.0}) holes.push_back({{x, y}, {x + 2, y}, {x + 2, y + 2}, {x, y + 2}});
  }
  check_pieces({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, holes, 1);
  EXPECT_EQ(without_holes({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, std::span(holes).first(1), {}).size(), 2U);
}

TEST(PolygonHoles, ThatAreMisplacedAreRefused) {
  const Ring outer{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  EXPECT_TRUE(without_holes(outer, std::vector<Ring>{{{1, 1}, {2, 2}, {3, 3}}}, {}).empty()) << "no area";
  EXPECT_TRUE(without_holes(outer, std::vector<Ring>{{{20, 1}, {22, 1}, {22, 3}}}, {}).empty()) << "outside";
  const auto refused = [&](const std::vector<Ring>& holes) { return without_holes(outer, holes, {}).empty(); };
  EXPECT_TRUE(refused({{{8, 1}, {12, 1}, {12, 3}, {8, 3}}})) << "crosses the outline";
  EXPECT_TRUE(refused({{{8, 1}, {10, 1}, {10, 3}, {8, 3}}})) << "shares a piece of a side with the outline";
  EXPECT_TRUE(refused({{{8, 1}, {10, 2}, {12, 1}, {11, 4}}})) << "crosses the outline in a corner of its own";
  EXPECT_TRUE(refused({{{10, 2}, {12, 1}, {12, 3}}})) << "touches the outline from outside";
  EXPECT_TRUE(refused({{{10, 10}, {12, 10}, {11, 13}}})) << "touches a corner from outside";
  EXPECT_TRUE(refused({{{0, 0}, {10, 0}, {10, 10}, {0, 10}}})) << "is the outline";
  EXPECT_TRUE(refused({{{1, 1}, {5, 1}, {5, 5}, {1, 5}}, {{4, 4}, {7, 4}, {7, 7}, {4, 7}}})) << "crosses a hole";
  EXPECT_TRUE(refused({{{1, 1}, {5, 1}, {5, 5}, {1, 5}}, {{2, 2}, {3, 2}, {3, 3}}})) << "lies in a hole";
  EXPECT_TRUE(refused({{{1, 1}, {5, 1}, {5, 5}, {1, 5}}, {{1, 1}, {3, 2}, {2, 3}}}))
      << "lies in a hole that it touches";
  EXPECT_TRUE(refused({{{1, 1}, {3, 1}, {2, 3}}, {{1, 1}, {3, 1}, {2, 0.5}}})) << "shares a side with a hole";
}

double blocked_area(const Ring& outer, const std::vector<Ring>& holes) {
  double sum = 0.0;
  for (const Ring& piece : without_holes(outer, holes, {})) sum += area(piece);
  return sum;
}

TEST(PolygonHoles, MayTouchTheOutlineAndEachOtherAtPoints) {
  const Ring outer{{0, 0}, {10, 0}, {10, 8}, {0, 8}};
  EXPECT_EQ(blocked_area(outer, {{{4, 0}, {6, 3}, {3, 3}}}), 75.5);
  EXPECT_EQ(blocked_area(outer, {{{2, 2}, {5, 4}, {2, 6}}, {{5, 4}, {8, 2}, {8, 6}}}), 68.0);
  const std::vector<std::vector<Ring>> cases{
      {{{4, 0}, {6, 3}, {3, 3}}},                                    // a side from above
      {{{4, 8}, {6, 5}, {3, 5}}},                                    // and from below
      {{{0, 4}, {3, 3}, {3, 5}}, {{10, 4}, {7, 3}, {7, 5}}},         // upright sides
      {{{0, 0}, {3, 1}, {1, 3}}, {{10, 8}, {7, 7}, {9, 5}}},         // corners
      {{{0, 4}, {5, 3}, {10, 4}, {5, 5}}},                           // two sides: two parts are left
      {{{2, 2}, {5, 4}, {2, 6}}, {{5, 4}, {8, 2}, {8, 6}}},          // a corner of both
      {{{2, 2}, {5, 2}, {5, 6}, {2, 6}}, {{5, 4}, {8, 2}, {8, 6}}},  // a corner on a side
      {{{1, 4}, {3, 3}, {3, 5}},
       {{1, 4}, {3, 1}, {3, 2}},
       {{1, 4}, {3, 6}, {3, 7}}},  // three by their leftmost corners
      {{{3, 4}, {1, 3}, {1, 5}}, {{3, 4}, {5, 3}, {5, 5}}, {{3, 4}, {4, 6}, {2, 6}}, {{3, 4}, {4, 1}, {2, 1}}},
      {{{1, 1}, {9, 1}, {9, 7}, {8, 7}, {8, 2}, {1, 2}}, {{8, 4}, {6, 3}, {6, 5}}, {{4, 2}, {5, 5}, {3, 5}}}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    SCOPED_TRACE(i);
    check_pieces(outer, cases[i], i);
    for (const bool leans : {false, true}) {  // turned by 90 degrees, and sheared, which is exact
      const auto moved = [&](Ring ring) {
        for (Vec2& p : ring) p = leans ? Vec2{p.x + p.y / 4, p.y + p.x / 2} : Vec2{-p.y, p.x};
        return ring;
      };
      std::vector<Ring> holes;
      for (const Ring& hole : cases[i]) holes.push_back(moved(hole));
      check_pieces(moved(outer), holes, i);
    }
  }
}

TEST(PolygonHoles, FieldsOfThemThatTouchAreCutIntoPiecesThatCoverThePolygon) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<Ring> holes;
    const double share = 0.3 + 0.7 * uniform(seed, 0, 1);
    for (std::uint64_t cell = 0; cell < 100; ++cell) {
      const double x = static_cast<double>(cell % 10);
      const double y = static_cast<double>(cell / 10);
      if (uniform(seed, cell, 0) >= share) continue;
      if (uniform(seed, cell, 2) < 0.3) {  // a triangle in the diamond
        holes.push_back({{x + 0.5, y}, {x + 1, y + 0.5}, {x, y + 0.5}});
      } else {
        holes.push_back({{x + 0.5, y}, {x + 1, y + 0.5}, {x + 0.5, y + 1}, {x, y + 0.5}});
      }
    }
    Ring outer{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    if (seed % 2 == 1) {
      for (Ring& hole : holes) {
        for (Vec2& p : hole) p = {p.x - p.y / 4, p.y + p.x / 2};
      }
      for (Vec2& p : outer) p = {p.x - p.y / 4, p.y + p.x / 2};
    }
    check_pieces(outer, holes, seed);
  }
}

TEST(PolygonHoles, RingsThatMeetThemselvesAreHandedBackToBeRefused) {
  const Ring square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const Ring crossed{{1, 1}, {4, 4}, {4, 1}, {1, 5}};
  for (const auto& pieces : {without_holes(crossed, std::vector<Ring>{{{1.2, 3}, {1.3, 3}, {1.2, 3.1}}}, {}),
                             without_holes(square, std::vector<Ring>{crossed}, {})}) {
    ASSERT_EQ(pieces.size(), 1U);
    Scene scene;
    scene.polygons.push_back({pieces[0], 7});
    EXPECT_THROW(plane_obstacles(scene, {}), InputError);
  }
}

/// `side` times `side` small stars in a square, each turned and moved a little.
std::vector<Ring> many_holes(int side) {
  std::vector<Ring> holes;
  for (int i = 0; i < side * side; ++i) {
    const Vec2 center{10.0 * (i % side + 0.5) / side, 10.0 * (i / side + 0.5) / side};
    holes.push_back(star(3, static_cast<std::uint64_t>(i), center, 4.0 / side, 3 + i % 4));
  }
  return holes;
}

TEST(PolygonHoles, HundredsAreCutIntoPiecesThatCoverThePolygon) {
  check_pieces({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, many_holes(17), 5);
}

TEST(PolygonHoles, OfTwentyThousandEachCostsTwoCutsAndNoCornerHasMany) {
  const std::vector<Ring> holes = many_holes(142);
  const std::vector<Ring> pieces = without_holes({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, holes, {});
  std::size_t corners = 4;
  for (const Ring& hole : holes) corners += hole.size();
  std::size_t sides = 0;
  std::vector<Vec2> all;
  for (const Ring& piece : pieces) {
    sides += piece.size();
    all.insert(all.end(), piece.begin(), piece.end());
  }
  const std::size_t cuts = (sides - corners) / 2;  // each is a side of two pieces
  EXPECT_EQ(pieces.size(), cuts - holes.size() + 1) << "Euler";
  EXPECT_LE(cuts, 2 * holes.size());
  EXPECT_GT(cuts, holes.size());
  std::sort(all.begin(), all.end(), is_before);
  std::size_t most = 0;
  for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
    while (last < all.size() && all[last] == all[first]) ++last;
    most = std::max(most, last - first);
  }
  EXPECT_LE(most, 6U) << "of a corner with k cuts k + 1 pieces";
}

}  // namespace
}  // namespace warren
