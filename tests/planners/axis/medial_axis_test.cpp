// SPDX-License-Identifier: BSD-3-Clause
#include "planners/axis/medial_axis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "bench/plain_graph.hpp"
#include "core/base/error.hpp"
#include "core/plane/geometry.hpp"
#include "core/search/graph.hpp"
#include "planners/vertical_cells/cell_decomposition.hpp"
#include "tests/planners/visibility/plane_worlds.hpp"

namespace warren {
namespace {

using test::Dice;
using test::disjoint_polygons;

constexpr double infinity = std::numeric_limits<double>::infinity();

PlaneObstacles room(const Box& bounds, std::vector<Segment> walls = {}) {
  PlaneObstacles obstacles;
  obstacles.bounds = bounds;
  obstacles.walls = std::move(walls);
  return obstacles;
}

/// Distances to the nearest and the second nearest of the obstacles that p sees on different sides, by brute force.
double nearest(const MedialAxis& axis, Vec2 p) {
  double least = infinity;
  for (const Segment& s : axis.obstacles) least = std::min(least, distance(p, s));
  return least;
}

double total_length(const MedialAxis& axis) {
  double sum = 0.0;
  for (const AxisEdge& e : axis.edges) sum += e.length;
  return sum;
}

/// Distance of p to the nearest of the axis' curves' polylines.
double distance_to_axis(const MedialAxis& axis, Vec2 p) {
  double least = infinity;
  for (const AxisEdge& e : axis.edges) {
    std::vector<Vec2> line{axis.vertices[e.from]};
    axis.curve(e).append_polyline(line);
    for (std::size_t i = 1; i < line.size(); ++i) least = std::min(least, distance(p, Segment{line[i - 1], line[i]}));
  }
  return least;
}

TEST(AxisCurve, ArcBetweenPointAndLineIsTheParabola) {
  const Segment point{{0, 2}, {0, 2}};
  const Segment line{{-10, 0}, {10, 0}};
  const auto on = [](double x) { return Vec2{x, (x * x + 4.0) / 4.0}; };
  const AxisCurve arc(point, line, on(-3.0), on(5.0));
  double sampled = 0.0;
  for (int i = 0; i < 100'000; ++i) sampled += distance(on(-3.0 + 8e-5 * i), on(-3.0 + 8e-5 * (i + 1)));
  EXPECT_NEAR(arc.length(), sampled, 1e-8);
  EXPECT_EQ(arc.at(arc.waist()), (Vec2{0.0, 1.0}));
  std::vector<Vec2> polyline{on(-3.0)};
  arc.append_polyline(polyline);
  EXPECT_EQ(polyline.back(), on(5.0));
  double least = infinity;
  double length = 0.0;
  for (std::size_t i = 1; i < polyline.size(); ++i) {
    const Segment leg{polyline[i - 1], polyline[i]};
    least = std::min({least, distance(point.a, leg), distance(leg, Segment{line.a, line.b})});
    length += distance(leg.a, leg.b);
  }
  EXPECT_EQ(least, 1.0);  // exactly: the tangent at the narrowest point
  EXPECT_GE(length, arc.length());
  EXPECT_LE(length, arc.length() * 1.0001);
  const AxisCurve back = arc.part(arc.last(), arc.first(), arc.to(), arc.from());
  EXPECT_DOUBLE_EQ(back.length(), arc.length());
  const AxisCurve before = arc.part(arc.first(), 0.0, arc.from(), arc.at(0.0));
  const AxisCurve behind = arc.part(0.0, arc.last(), arc.at(0.0), arc.to());
  EXPECT_NEAR(before.length() + behind.length(), arc.length(), 1e-12);
}

TEST(MedialAxis, OfASquareIsItsDiagonals) {
  const MedialAxis axis(room({{0, 0}, {4, 4}}), {});
  EXPECT_NEAR(total_length(axis), 2.0 * std::sqrt(32.0), 1e-9);
  for (const AxisEdge& e : axis.edges) {
    const Vec2 middle = axis.curve(e).at(0.5 * (axis.curve(e).first() + axis.curve(e).last()));
    EXPECT_NEAR(std::min(std::abs(middle.x - middle.y), std::abs(middle.x + middle.y - 4.0)), 0.0, 1e-9);
  }
  EXPECT_EQ(snap_segments(axis.obstacles, {}).error, 0.0);
}

TEST(MedialAxis, OfACorridorIsItsMiddleAndTheCornersBisectors) {
  const MedialAxis axis(room({{0, 0}, {10, 2}}), {});
  EXPECT_NEAR(total_length(axis), 8.0 + 4.0 * std::sqrt(2.0), 1e-9);
  const auto middle =
      std::count_if(axis.edges.begin(), axis.edges.end(), [](const AxisEdge& e) { return e.clearance > 0.9; });
  EXPECT_EQ(middle, 1);
}

TEST(MedialAxis, PassesAWallsEndOnAParabola) {
  const MedialAxis axis(room({{0, 0}, {20, 4}}, {{{10, 4}, {10, 2}}}), {});
  EXPECT_NEAR(distance_to_axis(axis, {10, 1}), 0.0, 1e-9);     // below the end: halfway to the floor
  EXPECT_NEAR(distance_to_axis(axis, {11, 1.25}), 0.0, 1e-3);  // (x^2 + 4) / 4
  double least = infinity;
  for (const AxisEdge& e : axis.edges) {
    if (e.clearance > 0.1) least = std::min(least, e.clearance);
  }
  EXPECT_EQ(least, 1.0);
}

TEST(MedialAxis, PointsOnItHaveTwoNearestObstaclesAndLieInFreeSpace) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    PlaneObstacles obstacles = disjoint_polygons(seed, 2);
    if (obstacles.polygons.empty()) continue;
    obstacles.walls = {{{-11.5, 3.25}, {-10.0, 4.5}}, {{-12, -11.3}, {-11.7, -11.3}}};
    const MedialAxis axis(obstacles, {});
    Dice dice(seed);
    const double size = axis.frame.width();
    ASSERT_FALSE(axis.edges.empty());
    for (const AxisEdge& e : axis.edges) {
      const AxisCurve curve = axis.curve(e);
      double least = infinity;
      for (int i = 0; i <= 8; ++i) {
        const Vec2 p = curve.at(curve.first() + i / 8.0 * (curve.last() - curve.first()));
        const double one = distance(p, axis.obstacles[axis.sites[e.site].segment]);
        const double other = distance(p, axis.obstacles[axis.sites[e.other].segment]);
        EXPECT_NEAR(one, other, 1e-7 * size);
        EXPECT_NEAR(nearest(axis, p), one, 1e-7 * size);
        EXPECT_TRUE(axis.frame.grown(1e-7 * size).contains(p));
        least = std::min({least, one, other});
        if (one > 1e-6 * size) {
          EXPECT_TRUE(axis.frame.contains(p) && !strictly_inside(obstacles.polygons, p));
        }
      }
      EXPECT_LE(e.clearance, least + 1e-7 * size);
      EXPECT_GE(e.clearance, least * 0.7 - 1e-7 * size);  // the sampled points come near the narrowest one
    }
  }
}

TEST(MedialAxis, JoinsAllOfAConnectedFreeSpace) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const PlaneObstacles obstacles = disjoint_polygons(seed, 3);
    if (obstacles.polygons.empty()) continue;
    const MedialAxis axis(obstacles, {});
    std::vector<Edge> edges;
    std::vector<char> is_end(axis.vertices.size(), 0);
    for (const AxisEdge& e : axis.edges) {
      if (e.from != e.to) edges.push_back({e.from, e.to});
      is_end[e.from] = is_end[e.to] = 1;
    }
    const Components parts = bench::plain_components(bench::plain_graph(axis.vertices.size(), edges));
    for (VertexId v = 0; v < axis.vertices.size(); ++v) {
      EXPECT_TRUE(is_end[v] == 0 || parts.connected(v, axis.edges.front().from));
    }
  }
}

TEST(MedialAxis, SplitsWhatEndsOnCrossesOrCoversEachOther) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    std::vector<Segment> segments;
    const auto any = [&] {
      return seed % 2 == 0 ? Vec2{1.0 * dice.roll(12), 1.0 * dice.roll(12)} : Vec2{12 * dice.real(), 12 * dice.real()};
    };
    for (int i = 0; i < 30; ++i) segments.push_back({any(), any()});
    const SnappedSegments snapped = snap_segments(segments, {});
    const auto segment = [](const IntegerPiece& s) { return Segment{s.a, s.b}; };
    for (std::size_t i = 0; i < snapped.segments.size(); ++i) {
      const Segment s = segment(snapped.segments[i]);
      for (const Vec2 p : {s.a, s.b}) {  // not far from where it comes from
        const Vec2 at = snapped.grid.at(p.x, p.y);
        EXPECT_LE(distance(at, segments[snapped.segments[i].source]), snapped.error * 1.01 + 1e-15);
      }
      for (std::size_t j = 0; j < i; ++j) {
        const Segment t = segment(snapped.segments[j]);
        EXPECT_FALSE(segments_cross(s, t));
        for (const Vec2 p : {s.a, s.b}) EXPECT_TRUE(!on_segment(p, t) || p == t.a || p == t.b);
        for (const Vec2 p : {t.a, t.b}) EXPECT_TRUE(!on_segment(p, s) || p == s.a || p == s.b);
      }
    }
  }
}

TEST(MedialAxis, RefusesAWorldWithoutAnInside) {
  PlaneObstacles flat;
  flat.walls = {{{0, 0}, {4, 0}}};
  EXPECT_THROW(MedialAxis(flat, {}), InputError);
}

}  // namespace
}  // namespace warren
