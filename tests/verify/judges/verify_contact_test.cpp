// SPDX-License-Identifier: BSD-3-Clause
// What touching means: solid polygons, and paths along walls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/verify/judges/paths_among_walls.hpp"

namespace warren {
namespace {

using namespace paths_among_walls;

TEST(VerifyContact, PolygonsAreSolid) {
  for (const bool reversed : {false, true}) {
    Scene scene = scene_of(with_far_box({}, -10.0, 20.0));
    std::vector<Vec2> l_shape{{0.0, 0.0}, {4.0, 0.0}, {4.0, 1.0}, {1.0, 1.0}, {1.0, 4.0}, {0.0, 4.0}};
    if (reversed) std::reverse(l_shape.begin(), l_shape.end());
    scene.polygons.push_back({l_shape, 0});
    EXPECT_FALSE(verified(scene, {{0.5, 0.5}, {0.6, 0.5}}, 0.1).verified);  // inside, and far from the sides
    EXPECT_FALSE(verified(scene, std::vector<Vec2>{{0.5, 0.5}}, 0.0, Contact::allowed).verified);
    EXPECT_TRUE(verified(scene, {{2.0, 2.0}, {3.0, 2.0}}, 1.0).verified);
    EXPECT_FALSE(verified(scene, {{2.0, 2.0}, {3.0, 1.75}}, 1.0).verified);
    struct Case {
      std::vector<Vec2> path;
      bool blocked, allowed;
    };
    const Case cases[] = {
        {{{1.0, 4.0}, {1.0, 1.0}, {4.0, 1.0}}, false, true},              // slides along the notch
        {{{1.0, 5.0}, {1.0, 1.0}, {5.0, 1.0}}, false, true},              // from outside and out again
        {{{0.0, 0.0}, {1.0, 1.0}}, false, false},                         // corner to corner through the inside
        {{{1.0, 4.0}, {4.0, 1.0}}, false, true},                          // over the notch
        {{{0.0, 4.0}, {4.0, 0.0}}, false, false},                         // through both arms
        {{{-1.0, 1.0}, {1.0, -1.0}}, false, true},                        // touches the corner
        {{{0.0, -1.0}, {0.0, 5.0}}, false, true},                         // along a side and on
        {{{0.0, 2.0}, {1.0, 2.0}}, false, false},                         // from side to side
        {{{0.0, 2.0}, {-1.0, 2.0}}, false, true},                         // off a side
        {{{0.0, 0.0}, {4.0, 0.0}, {4.0, 1.0}, {1.0, 1.0}}, false, true},  // all along
        {{{1.0, 4.0}, {1.0, 0.5}}, false, false},                         // along a side, then inside
        {{{-1.0, -1.0}, {5.0, -1.0}}, true, true},
    };
    for (const Case& c : cases) {
      SCOPED_TRACE(testing::Message() << c.path[0].x << " " << c.path[0].y << " reversed " << reversed);
      EXPECT_EQ(verified(scene, c.path, 0.0).verified, c.blocked);
      EXPECT_EQ(verified(scene, c.path, 0.0, Contact::allowed).verified, c.allowed);
    }
  }
}

struct WallContact {
  const char* claim;
  std::vector<Segment> walls;
  std::vector<Vec2> path;
  bool allowed;
};

const Segment floor_wall{{0.0, 0.0}, {4.0, 0.0}};

/// One wall from (0, 0) to (4, 0).
std::vector<WallContact> contacts_with_one_wall() {
  return {
      {"running along a wall", {floor_wall}, {{-1.0, 0.0}, {5.0, 0.0}}, true},
      {"landing on a wall and leaving on the same side", {floor_wall}, {{1.0, 1.0}, {2.0, 0.0}, {3.0, 1.0}}, true},
      {"landing on a wall and leaving on the other side", {floor_wall}, {{1.0, 1.0}, {2.0, 0.0}, {3.0, -1.0}}, false},
      {"crossing a wall", {floor_wall}, {{2.0, 1.0}, {2.0, -1.0}}, false},
      {"running, then leaving on the side it came from",
       {floor_wall},
       {{1.0, 1.0}, {2.0, 0.0}, {3.0, 0.0}, {3.5, 1.0}},
       true},
      {"running, then leaving on the other side",
       {floor_wall},
       {{1.0, 1.0}, {2.0, 0.0}, {3.0, 0.0}, {3.5, -1.0}},
       false},
      {"around the end of a wall", {floor_wall}, {{3.0, 1.0}, {4.0, 0.0}, {3.0, -1.0}}, true},
      {"running to the end and back on the other side",
       {floor_wall},
       {{3.0, 1.0}, {3.0, 0.0}, {4.0, 0.0}, {2.0, -1.0}},
       true},
      {"over the end of a wall", {floor_wall}, {{4.0, 1.0}, {4.0, -1.0}}, true},
  };
}

/// It and others at its end.
std::vector<WallContact> contacts_where_walls_meet() {
  return {
      {"through the corner of two walls", {floor_wall, {{4.0, 0.0}, {4.0, 3.0}}}, {{3.0, 1.0}, {5.0, -1.0}}, false},
      {"past the corner of two walls outside", {floor_wall, {{4.0, 0.0}, {4.0, 3.0}}}, {{3.0, -1.0}, {5.0, 1.0}}, true},
      {"into the corner and back", {floor_wall, {{4.0, 0.0}, {4.0, 3.0}}}, {{3.0, 1.0}, {4.0, 0.0}, {3.0, 2.0}}, true},
      {"between two walls that meet end to end",
       {floor_wall, {{4.0, 0.0}, {8.0, 0.0}}},
       {{4.0, 1.0}, {4.0, -1.0}},
       false},
      {"changing sides where two walls meet end to end",
       {floor_wall, {{4.0, 0.0}, {8.0, 0.0}}},
       {{3.0, 1.0}, {3.0, 0.0}, {5.0, 0.0}, {5.0, -1.0}},
       false},
      {"changing sides in the gap between two walls",
       {floor_wall, {{4.5, 0.0}, {8.0, 0.0}}},
       {{3.0, 1.0}, {3.0, 0.0}, {5.0, 0.0}, {5.0, -1.0}},
       true},
  };
}

/// Others that stand on it.
std::vector<WallContact> runs_past_walls() {
  return {
      {"running past a wall that ends here, on its side",
       {floor_wall, {{2.0, 0.0}, {2.0, 2.0}}},
       {{1.0, 1.0}, {1.0, 0.0}, {3.0, 0.0}},
       false},
      {"running past a wall that ends here, on the other side",
       {floor_wall, {{2.0, 0.0}, {2.0, 2.0}}},
       {{1.0, -1.0}, {1.0, 0.0}, {3.0, 0.0}},
       true},
      {"running between walls on both sides",
       {floor_wall, {{1.0, 0.0}, {1.0, 2.0}}, {{2.0, 0.0}, {2.0, -2.0}}},
       {{0.0, 0.0}, {4.0, 0.0}},
       false},
  };
}

/// Walls without length, overlapping, crossing; paths that stand still or turn back.
std::vector<WallContact> odd_contacts() {
  return {
      {"a wall of length zero stops nobody", {{{2.0, 2.0}, {2.0, 2.0}}}, {{1.0, 2.0}, {3.0, 2.0}}, true},
      {"a point on a wall doesn't open it", {floor_wall, {{2.0, 0.0}, {2.0, 0.0}}}, {{2.0, 1.0}, {2.0, -1.0}}, false},
      {"starting on a wall, either side", {floor_wall}, {{2.0, 0.0}, {2.0, -1.0}}, true},
      {"starting on a wall and coming back through it", {floor_wall}, {{2.0, 0.0}, {2.0, -1.0}, {3.0, 1.0}}, false},
      {"overlapping walls count once",
       {floor_wall, {{2.0, 0.0}, {6.0, 0.0}}},
       {{3.0, 1.0}, {3.0, 0.0}, {5.0, 0.0}, {5.0, 1.0}},
       true},
      {"overlapping walls close their ends", {floor_wall, {{2.0, 0.0}, {6.0, 0.0}}}, {{4.0, 1.0}, {4.0, -1.0}}, false},
      {"through a crossing", {floor_wall, {{1.0, 1.0}, {3.0, -1.0}}}, {{1.0, -1.0}, {3.0, 1.0}}, false},
      {"turning back at a wall", {floor_wall}, {{2.0, 1.0}, {2.0, 0.0}, {2.0, 1.0}}, true},
      {"standing still on a wall", {floor_wall}, {{2.0, 1.0}, {2.0, 0.0}, {2.0, 0.0}, {2.0, -1.0}}, false},
      {"a single point on a wall", {floor_wall}, {{2.0, 0.0}}, true},
  };
}

TEST(VerifyContact, ContactWithWallsFollowsTheRules) {
  std::vector<WallContact> cases;
  for (const auto& some : {contacts_with_one_wall(), contacts_where_walls_meet(), runs_past_walls(), odd_contacts()}) {
    cases.insert(cases.end(), some.begin(), some.end());
  }
  for (const WallContact& c : cases) {
    SCOPED_TRACE(c.claim);
    for (const bool box : {true, false}) {
      std::vector<Segment> walls = with_far_box(c.walls, box ? -20.0 : -30.0, 30.0);
      std::vector<Vec2> path = c.path;
      EXPECT_EQ(verified(scene_of(walls), path, 0.0, Contact::allowed).verified, c.allowed);
      EXPECT_FALSE(verified(scene_of(walls), path, 0.0).verified);  // every case touches something
      std::reverse(path.begin(), path.end());
      EXPECT_EQ(verified(scene_of(walls), path, 0.0, Contact::allowed).verified, c.allowed) << "backwards";
      for (Vec2& p : path) p = {1e6 - p.y, p.x};
      for (Segment& s : walls) s = {{1e6 - s.b.y, s.b.x}, {1e6 - s.a.y, s.a.x}};
      EXPECT_EQ(verified(scene_of(walls), path, 0.0, Contact::allowed).verified, c.allowed) << "turned";
    }
  }
}

TEST(VerifyContact, TheBoxCannotBeSlippedAround) {
  std::vector<Segment> walls = with_far_box({{{2.0, 0.0}, {2.0, 3.0}}}, 0.0, 5.0);
  const std::vector<Vec2> past{{1.0, 1.0}, {1.0, 0.0}, {3.0, 0.0}, {3.0, 1.0}};  // under the wall, on the outline
  EXPECT_FALSE(verified(scene_of(walls), past, 0.0, Contact::allowed).verified);
  EXPECT_TRUE(
      verified(scene_of(walls), {{1.0, 1.0}, {1.0, 0.0}, {2.0, 0.0}, {2.0, 3.0}, {3.0, 1.0}}, 0.0, Contact::allowed)
          .verified);
  EXPECT_FALSE(verified(scene_of(walls), {{1.0, 0.0}, {3.0, 0.0}}, 0.0, Contact::allowed).verified);  // or behind it
  EXPECT_TRUE(verified(scene_of(walls), {{0.0, 0.0}, {2.0, 0.0}}, 0.0, Contact::allowed).verified);
}

// ---- contact allowed, decided by an oracle: can the path be moved off its obstacles by a thousandth?
// -----------------

constexpr int ring_size = 120;
Vec2 ring_point(Vec2 at, int i) {
  const double angle = (i + 0.123456) * 2.0 * std::numbers::pi / ring_size;
  return {at.x + 1e-3 * std::cos(angle), at.y + 1e-3 * std::sin(angle)};
}
bool crosses_any(const std::vector<Segment>& walls, Vec2 p, Vec2 q) {
  const auto side = [](Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a) > 0.0; };
  return std::any_of(walls.begin(), walls.end(), [&](const Segment& w) {
    return side(w.a, w.b, p) != side(w.a, w.b, q) && side(p, q, w.a) != side(p, q, w.b);
  });
}
using Reached = std::vector<char>;
void spread(Reached& ring, Vec2 at, const std::vector<Segment>& walls) {
  for (int pass = 0; pass < 2 * ring_size; ++pass) {
    for (const int step : {1, ring_size - 1}) {
      const int i = step == 1 ? pass % ring_size : ring_size - 1 - pass % ring_size;
      const int j = (i + step) % ring_size;
      if (ring[i] != 0 && ring[j] == 0 && !crosses_any(walls, ring_point(at, i), ring_point(at, j))) ring[j] = 1;
    }
  }
}
/// Rings of points around every contact point: can one get from ring to ring, and around each, without crossing a wall?
bool can_be_moved_off(const std::vector<Segment>& walls, const std::vector<Vec2>& path,
                      const std::vector<Vec2>& triangle) {
  std::vector<Vec2> stops{path.front()};
  for (std::size_t leg = 0; leg + 1 < path.size(); ++leg) {
    const Segment s{path[leg], path[leg + 1]};
    std::vector<Vec2> here{s.b};
    for (const Segment& w : walls) {
      for (const Vec2 p : {w.a, w.b}) {
        if (on(s, p)) here.push_back(p);
      }
    }
    std::sort(here.begin(), here.end(), [&](Vec2 p, Vec2 q) { return norm(p - s.a) < norm(q - s.a); });
    stops.insert(stops.end(), here.begin(), here.end());
  }
  Reached ring(ring_size, 1);
  for (int i = 0; i < ring_size && !triangle.empty(); ++i) {
    const Vec2 p = ring_point(stops[0], i);
    int left = 0;
    for (int k = 0; k < 3; ++k) left += cross(triangle[(k + 1) % 3] - triangle[k], p - triangle[k]) > 0.0 ? 1 : 0;
    if (left == 3) ring[i] = 0;
  }
  for (std::size_t stop = 0; stop + 1 < stops.size(); ++stop) {
    spread(ring, stops[stop], walls);
    Reached next(ring_size, 0);
    for (int i = 0; i < ring_size; ++i) {
      for (int j = 0; j < ring_size && ring[i] != 0; ++j) {
        if (next[j] == 0 && !crosses_any(walls, ring_point(stops[stop], i), ring_point(stops[stop + 1], j)))
          next[j] = 1;
      }
    }
    ring = next;
  }
  return std::count(ring.begin(), ring.end(), 0) < ring_size;
}

TEST(VerifyContact, ContactAllowedMeansThatThePathCanBeMovedOffTheWalls) {
  int allowed = 0;
  int refused_touching = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<Segment> walls;
    for (std::uint64_t i = 0; i < 2 + seed % 3; ++i)
      walls.push_back({random_point(seed, 2 * i, 4.0), random_point(seed, 2 * i + 1, 4.0)});
    std::vector<Vec2> path;
    for (std::uint64_t i = 0; i < 3 + seed % 2; ++i) path.push_back(random_point(seed + 5000, i, 4.0));
    Scene scene = scene_of(with_far_box(walls, -9.0, 9.0));
    std::vector<Vec2> triangle;
    if (seed % 4 == 0) {
      for (std::uint64_t i = 0; i < 3; ++i) triangle.push_back(random_point(seed + 9000, i, 4.0));
      if (cross_int(triangle[0], triangle[1], triangle[2]) == 0) continue;
      scene.polygons.push_back({triangle, 0});
      if (cross_int(triangle[0], triangle[1], triangle[2]) < 0) std::swap(triangle[1], triangle[2]);
      for (std::size_t i = 0; i < 3; ++i) walls.push_back({triangle[i], triangle[(i + 1) % 3]});
    }
    const Verification v = verified(scene, path, 0.0, Contact::allowed);
    EXPECT_EQ(v.verified, can_be_moved_off(walls, path, triangle));
    if (v.min_clearance > 0.0) continue;
    allowed += v.verified ? 1 : 0;
    refused_touching += v.verified ? 0 : 1;
  }
  EXPECT_GT(allowed, 50);
  EXPECT_GT(refused_touching, 50);
}

}  // namespace
}  // namespace warren
